#include "aqm/row_pairs.h"

#include <hwy/highway.h>

#include <algorithm>

namespace promenade::aqm {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, 8>;

const float* asFloats(const std::complex<float>* numbers) {
  return reinterpret_cast<const float*>(numbers);
}
float* asFloats(std::complex<float>* numbers) {
  return reinterpret_cast<float*>(numbers);
}

}  // namespace

void packRows(const std::complex<float>* a, const std::complex<float>* b, int begin, int end, int length,
              std::complex<float>* packed) {
  const auto packReal = [&](int ix) { packed[ix] = {a[ix].real(), b[ix].real()}; };
  if (begin == 0 && end > 0) packReal(0);
  if (length % 2 == 0 && begin <= length / 2 && end > length / 2) packReal(length / 2);

  int ix = std::max(begin, 1);
  const int last = std::min(end, (length + 1) / 2);
  const Lanes tag;
  const hn::RepartitionToWide<Lanes> pairs;  // a complex number is moved as one of twice the bits
  const int numbers = static_cast<int>(hn::Lanes(tag)) / 2;
  for (; ix + numbers <= last; ix += numbers) {
    const auto first = hn::LoadU(tag, asFloats(a + ix));
    const auto turned = hn::Reverse2(tag, hn::LoadU(tag, asFloats(b + ix)));  // imaginary, real
    const auto sum = hn::Add(first, turned);
    // A + i B = (a.re - b.im, a.im + b.re); its mirror image conj(A) + i conj(B) = (a.re + b.im, b.re -
    // a.im).
    hn::StoreU(hn::OddEven(sum, hn::Sub(first, turned)), tag, asFloats(packed + ix));
    const auto mirrored = hn::OddEven(hn::Sub(turned, first), sum);
    hn::StoreU(hn::BitCast(tag, hn::Reverse(pairs, hn::BitCast(pairs, mirrored))), tag,
               asFloats(packed + length - ix - numbers + 1));
  }
  for (; ix < last; ++ix) {
    packed[ix] = {a[ix].real() - b[ix].imag(), a[ix].imag() + b[ix].real()};
    packed[length - ix] = {a[ix].real() + b[ix].imag(), b[ix].real() - a[ix].imag()};
  }
}

void addRowPair(const std::complex<float>* pair, const float* weightsA, const float* weightsB, float* a,
                float* b, int count) {
  const Lanes tag;
  for (int x = 0; x < count; x += static_cast<int>(hn::Lanes(tag))) {
    auto first = hn::Zero(tag);
    auto second = hn::Zero(tag);
    hn::LoadInterleaved2(tag, asFloats(pair + x), first, second);
    const auto add = [&](auto value, const float* weights, float* to) {
      const auto weighted = hn::Mul(hn::Load(tag, weights + x), value);
      hn::Store(hn::Add(hn::Load(tag, to + x), weighted), tag, to + x);
    };
    add(first, weightsA, a);
    add(second, weightsB, b);
  }
}

}  // namespace promenade::aqm
