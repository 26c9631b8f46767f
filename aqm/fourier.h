#pragma once
// The one-dimensional Fourier transforms that the two-dimensional ones are made of, so that rows and columns
// which are known to be zero, or are not wanted, cost nothing and the rest can be shared among threads.

#include <complex>
#include <memory>

#include "src/core/image.h"

struct fftwf_plan_s;

namespace promenade::aqm {

/// Plans for the rows and columns of a real image of one size. No transform is scaled: forward and back
/// multiplies by width * height. All buffers must start on 64 bytes (as rows of a Plane do); the execution is
/// thread-safe. Plans are made without timing ("estimate"), so that the same image gives the same bits in
/// every run.
class FourierPlans {
 public:
  explicit FourierPlans(Size size);

  /// width reals -> width/2 + 1 complex numbers.
  void forwardRow(const float* from, std::complex<float>* to) const;
  /// height complex numbers -> as many, not in place.
  void forwardColumn(const std::complex<float>* from, std::complex<float>* to) const;
  void inverseColumn(const std::complex<float>* from, std::complex<float>* to) const;
  /// width/2 + 1 complex numbers, which are overwritten, -> width reals.
  void inverseRow(std::complex<float>* from, float* to) const;
  /// Two rows at once (row_pairs.h): width complex numbers -> as many, not in place.
  void inverseRowPair(const std::complex<float>* from, std::complex<float>* to) const;

 private:
  struct Destroy {
    void operator()(fftwf_plan_s* plan) const;
  };
  using Plan = std::unique_ptr<fftwf_plan_s, Destroy>;

  Plan forwardRow_;
  Plan forwardColumn_;
  Plan inverseColumn_;
  Plan inverseRow_;
  Plan inverseRowPair_;
};

}  // namespace promenade::aqm
