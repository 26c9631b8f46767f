#include "src/render/sampler.h"

#include <algorithm>
#include <bit>

namespace promenade::render {
namespace {

std::uint32_t reverseBits(std::uint32_t v) {
  v = __builtin_bswap32(v);
  v = ((v & 0x0f0f0f0fu) << 4) | ((v >> 4) & 0x0f0f0f0fu);
  v = ((v & 0x33333333u) << 2) | ((v >> 2) & 0x33333333u);
  return ((v & 0x55555555u) << 1) | ((v >> 1) & 0x55555555u);
}

// Finalizer of lowbias32 (Wellons 2018): every input bit reaches every output bit.
std::uint32_t mixBits(std::uint32_t v) {
  v ^= v >> 16;
  v *= 0x7feb352du;
  v ^= v >> 15;
  v *= 0x846ca68bu;
  return v ^ (v >> 16);
}

std::uint32_t combine(std::uint32_t hash, std::uint32_t value) {
  return mixBits(hash * 0x9e3779b1u + value + 0x7f4a7c15u);
}

// Owen scrambling of a bit-reversed number: bit k is flipped depending on the bits below k only.
std::uint32_t scrambleReversed(std::uint32_t v, std::uint32_t seed) {
  v ^= v * 0x3d20adeau;
  v += seed;
  v *= (seed >> 16) | 1u;
  v ^= v * 0x05526c56u;
  v ^= v * 0x53a22864u;
  return v;
}

// Second Sobol dimension, bit-reversed. Its generator matrix is Pascal's triangle modulo 2, where C(k, j) is
// odd iff the bits of j are among those of k (Lucas): bit j of the result is the sum over all supersets k of
// j, which five butterfly steps compute.
std::uint32_t pascal(std::uint32_t v) {
  v ^= (v >> 16) & 0x0000ffffu;
  v ^= (v >> 8) & 0x00ff00ffu;
  v ^= (v >> 4) & 0x0f0f0f0fu;
  v ^= (v >> 2) & 0x33333333u;
  return v ^ ((v >> 1) & 0x55555555u);
}

/// The lower 16 bits moved to the even places (Morton order).
std::uint32_t spreadBits(std::uint32_t v) {
  v = (v | (v << 8)) & 0x00ff00ffu;
  v = (v | (v << 4)) & 0x0f0f0f0fu;
  v = (v | (v << 2)) & 0x33333333u;
  return (v | (v << 1)) & 0x55555555u;
}

float toUnit(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

}  // namespace

Sampler::Sampler(const Stream& stream, std::uint32_t path) {
  // A square tile of pixels, as large as 32 bits allow beside the paths, shares a sequence.
  const int pathBits = std::min(static_cast<int>(std::bit_width(stream.pathsPerPixel - 1)), 30);
  const int blockBits = static_cast<int>(std::bit_width(stream.block));
  const int tileBits = std::min((32 - pathBits - blockBits) / 2, 10);  // of each coordinate
  const std::uint32_t inTile = (1u << tileBits) - 1;
  const std::uint32_t order = spreadBits(stream.pixel.x & inTile) | spreadBits(stream.pixel.y & inTile) << 1;
  reversedIndex_ = reverseBits((((stream.block << (2 * tileBits)) + order) << pathBits) + path);
  streamHash_ = combine(combine(0, stream.seed), stream.frame);
  streamHash_ = combine(combine(streamHash_, stream.pixel.y >> tileBits), stream.pixel.x >> tileBits);
}

Sampler::Dimension Sampler::nextDimension() {
  const std::uint32_t hash = combine(streamHash_, dimension_++);
  // The shuffled index is an Owen scrambling of the number in the sequence: aligned blocks go to aligned
  // blocks.
  return {reverseBits(scrambleReversed(reversedIndex_, hash)), hash};
}

float Sampler::next1D() {
  const Dimension d = nextDimension();
  return toUnit(reverseBits(scrambleReversed(d.index, mixBits(d.hash ^ 0x68bc21ebu))));
}

glm::vec2 Sampler::next2D() {
  const Dimension d = nextDimension();
  return {toUnit(reverseBits(scrambleReversed(d.index, mixBits(d.hash ^ 0x68bc21ebu)))),
          toUnit(reverseBits(scrambleReversed(pascal(d.index), mixBits(d.hash ^ 0x02e5be93u))))};
}

}  // namespace promenade::render
