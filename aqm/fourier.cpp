#include "aqm/fourier.h"

#include <fftw3.h>

#include <mutex>

#include "aqm/plane.h"

namespace promenade::aqm {
namespace {

/// FFTW's planner (not its execution) keeps tables that all threads share: one plan is made or destroyed at a
/// time.
std::mutex& plannerMutex() {
  static std::mutex mutex;
  return mutex;
}

fftwf_complex* raw(std::complex<float>* numbers) {
  return reinterpret_cast<fftwf_complex*>(numbers);
}

/// FFTW takes inputs as pointers to mutable even where it keeps them (all but inverse real transforms do).
template <class T>
T* keptInput(const T* numbers) {
  return const_cast<T*>(numbers);
}

}  // namespace

void FourierPlans::Destroy::operator()(fftwf_plan_s* plan) const {
  const std::lock_guard lock(plannerMutex());
  fftwf_destroy_plan(plan);
}

FourierPlans::FourierPlans(Size size) {
  // Planning looks only at the alignment of the buffers.
  Plane<float> reals(size.width, 1);
  Plane<std::complex<float>> row(size.width / 2 + 1, 1);
  Plane<std::complex<float>> columns(size.height, 2);
  Plane<std::complex<float>> pair(size.width, 2);
  const std::lock_guard lock(plannerMutex());
  forwardRow_.reset(fftwf_plan_dft_r2c_1d(size.width, reals.row(0), raw(row.row(0)), FFTW_ESTIMATE));
  inverseRow_.reset(fftwf_plan_dft_c2r_1d(size.width, raw(row.row(0)), reals.row(0), FFTW_ESTIMATE));
  forwardColumn_.reset(
      fftwf_plan_dft_1d(size.height, raw(columns.row(0)), raw(columns.row(1)), FFTW_FORWARD, FFTW_ESTIMATE));
  inverseColumn_.reset(
      fftwf_plan_dft_1d(size.height, raw(columns.row(0)), raw(columns.row(1)), FFTW_BACKWARD, FFTW_ESTIMATE));
  inverseRowPair_.reset(
      fftwf_plan_dft_1d(size.width, raw(pair.row(0)), raw(pair.row(1)), FFTW_BACKWARD, FFTW_ESTIMATE));
}

void FourierPlans::forwardRow(const float* from, std::complex<float>* to) const {
  fftwf_execute_dft_r2c(forwardRow_.get(), keptInput(from), raw(to));
}

void FourierPlans::forwardColumn(const std::complex<float>* from, std::complex<float>* to) const {
  fftwf_execute_dft(forwardColumn_.get(), raw(keptInput(from)), raw(to));
}

void FourierPlans::inverseColumn(const std::complex<float>* from, std::complex<float>* to) const {
  fftwf_execute_dft(inverseColumn_.get(), raw(keptInput(from)), raw(to));
}

void FourierPlans::inverseRowPair(const std::complex<float>* from, std::complex<float>* to) const {
  fftwf_execute_dft(inverseRowPair_.get(), raw(keptInput(from)), raw(to));
}

void FourierPlans::inverseRow(std::complex<float>* from, float* to) const {
  fftwf_execute_dft_c2r(inverseRow_.get(), raw(from), to);
}

}  // namespace promenade::aqm
