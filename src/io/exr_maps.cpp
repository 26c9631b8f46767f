#include "src/io/exr_maps.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>

#include <cassert>

#include "src/core/errors.h"
#include "src/io/exr_memory_internal.h"
#include "src/io/exr_reading_internal.h"
#include "src/io/image_limits.h"

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

ProbabilityMap readProbability(const std::filesystem::path& file) {
  return readingExr(file, [&] {
    Imf::InputFile in(file.c_str(), 0);
    const Imath::Box2i window = in.header().dataWindow();
    const Size size{window.max.x + 1, window.max.y + 1};
    if (window.min != Imath::V2i(0, 0) || in.header().channels().findChannel("P") == nullptr) {
      throw InputError(file.string(), "not a file of the metric's maps: no channel P");
    }
    requireReasonableSize(file, size);
    ProbabilityMap probability(size);
    Imf::FrameBuffer buffer;
    buffer.insert("P", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(probability.pixels().data()),
                                  sizeof(float), sizeof(float) * static_cast<std::size_t>(size.width)));
    in.setFrameBuffer(buffer);
    in.readPixels(0, size.height - 1);
    return probability;
  });
}

}  // namespace promenade::io
