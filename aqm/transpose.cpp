#include "aqm/transpose.h"

#include <hwy/highway.h>

namespace promenade::aqm {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
/// A complex float is moved as one 64-bit number.
using Quad = hn::CappedTag<double, 4>;

const double* asDoubles(const std::complex<float>* numbers) {
  return reinterpret_cast<const double*>(numbers);
}
double* asDoubles(std::complex<float>* numbers) {
  return reinterpret_cast<double*>(numbers);
}

}  // namespace

void transposeRows(const Spectrum& from, int first, int count, int begin, int end, Spectrum& to) {
  const Quad tag;
  int ix = begin;
  if (hn::Lanes(tag) == 4) {
    for (; ix + 4 <= end; ix += 4) {
      int i = 0;
      for (; i + 4 <= count; i += 4) {
        const auto a = hn::LoadU(tag, asDoubles(from.row(ix) + first + i));
        const auto b = hn::LoadU(tag, asDoubles(from.row(ix + 1) + first + i));
        const auto c = hn::LoadU(tag, asDoubles(from.row(ix + 2) + first + i));
        const auto d = hn::LoadU(tag, asDoubles(from.row(ix + 3) + first + i));
        const auto evenAb = hn::InterleaveLower(tag, a, b);
        const auto oddAb = hn::InterleaveUpper(tag, a, b);
        const auto evenCd = hn::InterleaveLower(tag, c, d);
        const auto oddCd = hn::InterleaveUpper(tag, c, d);
        hn::StoreU(hn::ConcatLowerLower(tag, evenCd, evenAb), tag, asDoubles(to.row(i) + ix));
        hn::StoreU(hn::ConcatLowerLower(tag, oddCd, oddAb), tag, asDoubles(to.row(i + 1) + ix));
        hn::StoreU(hn::ConcatUpperUpper(tag, evenCd, evenAb), tag, asDoubles(to.row(i + 2) + ix));
        hn::StoreU(hn::ConcatUpperUpper(tag, oddCd, oddAb), tag, asDoubles(to.row(i + 3) + ix));
      }
      for (; i < count; ++i) {
        for (int k = 0; k < 4; ++k) {
          to.row(i)[ix + k] = from.row(ix + k)[first + i];
        }
      }
    }
  }
  for (; ix < end; ++ix) {
    for (int i = 0; i < count; ++i) {
      to.row(i)[ix] = from.row(ix)[first + i];
    }
  }
}

}  // namespace promenade::aqm
