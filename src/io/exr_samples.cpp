#include "src/io/exr_samples.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <type_traits>
#include <vector>

#include "src/core/errors.h"
#include "src/io/exr_memory_internal.h"
#include "src/io/exr_reading_internal.h"

namespace promenade::io {
namespace {

constexpr const char* kJobHash = "promenade:jobHash";
constexpr const char* kStatistics = "promenade:statistics";

// Where a file's channels lie in a frame; the sources are kept beside it, in an integer type that OpenEXR
// knows.
template <class FrameType, class Sources>
auto channelsOf(FrameType& frame, Sources& sources) {
  auto* diffuse = frame.diffuse.pixels().data();
  auto* glossy = frame.viewDependent.pixels().data();
  auto* normal = frame.visibility.normal.pixels().data();
  constexpr std::size_t kVec3 = sizeof(glm::vec3);
  return std::vector<ExrChannel>{
      {"R", Imf::FLOAT, &diffuse->r, kVec3},
      {"G", Imf::FLOAT, &diffuse->g, kVec3},
      {"B", Imf::FLOAT, &diffuse->b, kVec3},
      {"ViewDependent.R", Imf::FLOAT, &glossy->r, kVec3},
      {"ViewDependent.G", Imf::FLOAT, &glossy->g, kVec3},
      {"ViewDependent.B", Imf::FLOAT, &glossy->b, kVec3},
      {"Z", Imf::FLOAT, frame.visibility.depth.pixels().data(), sizeof(float)},
      {"N.X", Imf::FLOAT, &normal->x, kVec3},
      {"N.Y", Imf::FLOAT, &normal->y, kVec3},
      {"N.Z", Imf::FLOAT, &normal->z, kVec3},
      {"Item.ID", Imf::UINT, frame.visibility.item.pixels().data(), sizeof(ItemId)},
      {"Source", Imf::UINT, sources.data(), sizeof(unsigned)},
  };
}

}  // namespace

void writeSamples(const std::filesystem::path& file, const Frame& frame, const SamplesNote& note) {
  const Size size = frame.diffuse.size();
  Imf::Header header(size.width, size.height);
  header.insert(kJobHash, Imf::StringAttribute(note.jobHash));
  header.insert(kStatistics, Imf::StringAttribute(note.statistics));
  std::vector<unsigned> sources;
  for (const SampleSource source : frame.source.pixels()) {
    sources.push_back(static_cast<unsigned>(source));
  }
  writeExr(file, header, channelsOf(frame, sources));
}

std::optional<SamplesFile> readSamples(const std::filesystem::path& file, const Camera& camera,
                                       const std::string& jobHash) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  return readingExr(file, [&]() -> std::optional<SamplesFile> {
    Imf::InputFile in(file.c_str(), 0);
    const auto text = [&](const char* name) {
      const auto* found = in.header().findTypedAttribute<Imf::StringAttribute>(name);
      return found == nullptr ? std::string() : found->value();
    };
    if (text(kJobHash) != jobHash) return std::nullopt;
    const Size size = camera.size();
    const auto window = in.header().dataWindow();
    if (window.min != Imath::V2i(0, 0) || window.max != Imath::V2i(size.width - 1, size.height - 1)) {
      throw InputError(file.string(), "expected samples of the size of this job's frames");
    }
    SamplesFile samples{{{camera, DepthMap(size), NormalMap(size), ItemBuffer(size)},
                         RadianceMap(size),
                         RadianceMap(size),
                         SourceMap(size)},
                        {jobHash, text(kStatistics)}};
    std::vector<unsigned> sources(size.area());
    Imf::FrameBuffer buffer;
    for (const ExrChannel& channel : channelsOf(samples.frame, sources)) {
      const Imf::Channel* found = in.header().channels().findChannel(channel.name);
      if (found == nullptr || found->type != channel.type) {
        throw InputError(file.string(), "not a file of samples: channel " + channel.name);
      }
      char* first = static_cast<char*>(const_cast<void*>(channel.first));
      buffer.insert(channel.name, Imf::Slice(channel.type, first, channel.stride,
                                             channel.stride * static_cast<std::size_t>(size.width)));
    }
    in.setFrameBuffer(buffer);
    in.readPixels(0, size.height - 1);
    for (std::size_t i = 0; i < sources.size(); ++i) {
      if (sources[i] > static_cast<unsigned>(SampleSource::kTracedItem)) {
        throw InputError(file.string(),
                         "channel Source: expected 0 to 5, found " + std::to_string(sources[i]));
      }
      samples.frame.source.pixels()[i] = static_cast<SampleSource>(sources[i]);
    }
    return samples;
  });
}

}  // namespace promenade::io
