#pragma once
// Two rows of a real image by one complex transform: with Hermitian spectra A and B, A + i B transforms to
// a + i b. A complex transform of n numbers takes less time than two of n/2 to n reals.

#include <complex>

#include "aqm/plane.h"

namespace promenade::aqm {

/// packed = A + i B, `length` numbers, from the halves of both spectra (columns 0 .. length/2) that are 0
/// outside of columns begin .. end - 1. Writes these columns and their mirror images only. What Hermitian
/// spectra cannot have (imaginary parts in column 0 and in that of Nyquist's frequency) is dropped.
void packRows(const std::complex<float>* a, const std::complex<float>* b, int begin, int end, int length,
              std::complex<float>* packed);

/// sums of a += weightsA * real parts, of b += weightsB * imaginary parts of `pair`, `count` of them, a
/// multiple of 8 (numbers beyond what counts are read and written). `pair` need not be aligned.
void addRowPair(const std::complex<float>* pair, const float* weightsA, const float* weightsB, float* a,
                float* b, int count);

}  // namespace promenade::aqm
