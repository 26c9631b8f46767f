#include "src/io/exr_maps.h"

#include <cassert>

#include "src/io/exr_memory_internal.h"

namespace promenade::io {

void writeMaps(const std::filesystem::path& file, const MetricMaps& maps) {
  const Size size = maps.jnd.size();
  assert(size.area() > 0 && maps.pooledJnd.size() == size && maps.probability.size() == size);
  assert(maps.signedProbability.empty() || maps.signedProbability.size() == maps.jnd.pixels().size());
  std::vector<ExrChannel> channels = {{"J", Imf::FLOAT, maps.jnd.pixels().data(), sizeof(float)},
                                      {"Jp", Imf::FLOAT, maps.pooledJnd.pixels().data(), sizeof(float)},
                                      {"P", Imf::FLOAT, maps.probability.pixels().data(), sizeof(float)}};
  if (!maps.signedProbability.empty()) {
    channels.push_back({"SignedP", Imf::FLOAT, maps.signedProbability.data(), sizeof(float)});
  }
  writeExr(file, Imf::Header(size.width, size.height), channels);
}

}  // namespace promenade::io
