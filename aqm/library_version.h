#pragma once

#include <string>

namespace promenade::aqm {

/// Of the FFTW that is loaded, e.g. "fftw-3.3.10-sse2-avx".
[[nodiscard]] std::string fftwVersion();

}  // namespace promenade::aqm
