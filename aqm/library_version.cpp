#include "aqm/library_version.h"

#include <fftw3.h>

namespace promenade::aqm {

std::string fftwVersion() {
  return fftwf_version;
}

}  // namespace promenade::aqm
