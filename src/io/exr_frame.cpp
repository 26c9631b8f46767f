#include "src/io/exr_frame.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfFramesPerSecond.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "src/core/errors.h"
#include "src/io/exr_memory_internal.h"
#include "src/io/exr_reading_internal.h"
#include "src/io/image_limits.h"

namespace promenade::io {
namespace {

namespace fs = std::filesystem;
using Imath::half;

constexpr float kLargestHalf = 65504.0f;

half toHalf(float value) {
  if (std::isnan(value)) return half(0.0f);
  return half(std::clamp(value, -kLargestHalf, kLargestHalf));
}

std::vector<half> toHalf(std::span<const glm::vec3> values) {
  std::vector<half> halves;
  halves.reserve(3 * values.size());
  for (const glm::vec3& v : values) {
    for (int i = 0; i < 3; ++i) halves.push_back(toHalf(v[i]));
  }
  return halves;
}

// OpenEXR's camera space (ImfStandardAttributes.h) is left-handed, x right, y up, z into the picture, and its
// vectors are rows: p' = p M. Rows of the result are the images of the world's axes and origin.
Imath::M44f worldToCamera(const Pose& pose) {
  Imath::M44d m;
  const glm::dmat3& axes = pose.worldFromCamera;  // columns: right, up, backward
  for (int i = 0; i < 3; ++i) {
    m[i][0] = axes[0][i];
    m[i][1] = axes[1][i];
    m[i][2] = -axes[2][i];
  }
  for (int k = 0; k < 3; ++k) m[3][k] = -(pose.eye.x * m[0][k] + pose.eye.y * m[1][k] + pose.eye.z * m[2][k]);
  return Imath::M44f(m);
}

// NDC: (0, 0) the upper left corner of the image, (1, 1) the lower right, y down, after division by w = z.
// Readers discard the third coordinate; (z - 1 cm) / z keeps the matrix invertible.
Imath::M44f worldToNdc(const Camera& camera) {
  const double focalX = camera.focalPixels() / camera.size().width;
  const double focalY = camera.focalPixels() / camera.size().height;
  const double centreX = 0.5 - camera.subpixelOffset().x / camera.size().width;
  const double centreY = 0.5 - camera.subpixelOffset().y / camera.size().height;
  const Imath::M44d project(focalX, 0, 0, 0,         //
                            0, -focalY, 0, 0,        //
                            centreX, centreY, 1, 1,  //
                            0, 0, -0.01, 0);
  return Imath::M44f(Imath::M44d(worldToCamera(camera.pose())) * project);
}

Imf::Header headerOf(const FrameMetadata& metadata) {
  const Camera& camera = metadata.camera;
  Imf::Header header(camera.size().width, camera.size().height);
  Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec. 709 with white D65
  Imf::addWorldToCamera(header, worldToCamera(camera.pose()));
  Imf::addWorldToNDC(header, worldToNdc(camera));
  if (metadata.framesPerSecond > 0.0) {
    Imf::addFramesPerSecond(header, Imf::guessExactFps(metadata.framesPerSecond));
    header.insert("promenade:framesPerSecond", Imf::DoubleAttribute(metadata.framesPerSecond));
  }
  header.insert("software", Imf::StringAttribute("Promenade " + metadata.programVersion));
  header.insert("promenade:version", Imf::StringAttribute(metadata.programVersion));
  header.insert("promenade:scene", Imf::StringAttribute(metadata.scene));
  header.insert("promenade:jobHash", Imf::StringAttribute(metadata.jobHash));
  header.insert("promenade:frame", Imf::IntAttribute(metadata.frame));
  header.insert("promenade:verticalFieldOfView", Imf::DoubleAttribute(camera.verticalFieldOfView()));
  const glm::dvec3 eye = camera.pose().eye;
  header.insert("promenade:eye", Imf::V3dAttribute(Imath::V3d(eye.x, eye.y, eye.z)));
  const glm::dmat3& axes = camera.pose().worldFromCamera;
  header.insert("promenade:cameraAxes",
                Imf::M33dAttribute(Imath::M33d(axes[0].x, axes[0].y, axes[0].z, axes[1].x, axes[1].y,
                                               axes[1].z, axes[2].x, axes[2].y, axes[2].z)));
  const glm::dvec2 offset = camera.subpixelOffset();
  header.insert("promenade:subpixelOffset", Imf::V2dAttribute(Imath::V2d(offset.x, offset.y)));
  return header;
}

template <class Attribute>
auto attribute(const Imf::Header& header, const char* name, const fs::path& file) {
  const auto* found = header.findTypedAttribute<Attribute>(name);
  if (found == nullptr) {
    throw InputError(file.string(), std::string("not a frame of Promenade: no attribute ") + name);
  }
  return found->value();
}

FrameMetadata metadataOf(const Imf::Header& header, const fs::path& file) {
  const auto window = header.dataWindow();
  if (window.min != Imath::V2i(0, 0) || window != header.displayWindow()) {
    throw InputError(file.string(), "not a frame of Promenade: its data window is not its display window");
  }
  FrameMetadata metadata;
  metadata.frame = attribute<Imf::IntAttribute>(header, "promenade:frame", file);
  metadata.programVersion = attribute<Imf::StringAttribute>(header, "promenade:version", file);
  metadata.scene = attribute<Imf::StringAttribute>(header, "promenade:scene", file);
  metadata.jobHash = attribute<Imf::StringAttribute>(header, "promenade:jobHash", file);
  if (const auto* fps = header.findTypedAttribute<Imf::DoubleAttribute>("promenade:framesPerSecond")) {
    metadata.framesPerSecond = fps->value();
  }
  const double fieldOfView = attribute<Imf::DoubleAttribute>(header, "promenade:verticalFieldOfView", file);
  if (!(fieldOfView > 0.0 && fieldOfView < std::numbers::pi)) {
    throw InputError(file.string(), "promenade:verticalFieldOfView: expected radians in (0, pi), found " +
                                        std::to_string(fieldOfView));
  }
  const Imath::V3d eye = attribute<Imf::V3dAttribute>(header, "promenade:eye", file);
  const Imath::M33d axes = attribute<Imf::M33dAttribute>(header, "promenade:cameraAxes", file);
  const Imath::V2d offset = attribute<Imf::V2dAttribute>(header, "promenade:subpixelOffset", file);
  Pose pose;
  for (int column = 0; column < 3; ++column) {
    pose.worldFromCamera[column] = {axes[column][0], axes[column][1], axes[column][2]};
  }
  pose.eye = {eye.x, eye.y, eye.z};
  const Size size{window.max.x + 1, window.max.y + 1};
  requireReasonableSize(file, size);
  metadata.camera = Camera(pose, fieldOfView, size, {offset.x, offset.y});
  return metadata;
}

}  // namespace

void writeFrame(const fs::path& file, const FrameFile& frame) {
  [[maybe_unused]] const Size size = frame.metadata.camera.size();
  assert(frame.radiance.size() == size);
  assert(frame.depth.empty() || frame.depth.size() == size);
  assert(frame.normal.empty() || frame.normal.size() == size);
  assert(frame.flowToNext.empty() || frame.flowToNext.size() == size);
  assert(frame.item.empty() || frame.item.size() == size);
  assert(frame.source.empty() || frame.source.size() == size);

  const std::vector<half> rgb = toHalf(frame.radiance.pixels());
  const std::vector<half> normals = toHalf(frame.normal.pixels());
  std::vector<half> sources;
  for (const SampleSource source : frame.source.pixels()) sources.emplace_back(static_cast<float>(source));

  constexpr std::size_t kThreeHalves = 3 * sizeof(half);
  std::vector<ExrChannel> channels{{"R", Imf::HALF, rgb.data(), kThreeHalves},
                                   {"G", Imf::HALF, rgb.data() + 1, kThreeHalves},
                                   {"B", Imf::HALF, rgb.data() + 2, kThreeHalves}};
  if (!frame.depth.empty()) {
    channels.push_back({"Z", Imf::FLOAT, frame.depth.pixels().data(), sizeof(float)});
  }
  if (!frame.normal.empty()) {
    channels.push_back({"N.X", Imf::HALF, normals.data(), kThreeHalves});
    channels.push_back({"N.Y", Imf::HALF, normals.data() + 1, kThreeHalves});
    channels.push_back({"N.Z", Imf::HALF, normals.data() + 2, kThreeHalves});
  }
  if (!frame.flowToNext.empty()) {
    const glm::vec2* flow = frame.flowToNext.pixels().data();
    channels.push_back({"Vector.X", Imf::FLOAT, &flow->x, sizeof(glm::vec2)});
    channels.push_back({"Vector.Y", Imf::FLOAT, &flow->y, sizeof(glm::vec2)});
  }
  if (!frame.item.empty())
    channels.push_back({"Item.ID", Imf::UINT, frame.item.pixels().data(), sizeof(ItemId)});
  if (!frame.source.empty()) channels.push_back({"Source", Imf::HALF, sources.data(), sizeof(half)});
  writeExr(file, headerOf(frame.metadata), channels);
}

RadianceMap asStored(const RadianceMap& radiance) {
  RadianceMap stored(radiance.size());
  const auto from = radiance.pixels();
  const auto to = stored.pixels();
  for (std::size_t i = 0; i < from.size(); ++i) {
    for (int c = 0; c < 3; ++c) to[i][c] = toHalf(from[i][c]);
  }
  return stored;
}

FrameFile readFrame(const fs::path& file) {
  return readingExr(file, [&] {
    Imf::InputFile in(file.c_str(), 0);
    FrameFile frame;
    frame.metadata = metadataOf(in.header(), file);
    const Size size = frame.metadata.camera.size();
    const Imf::ChannelList& present = in.header().channels();
    for (const char* name : {"R", "G", "B"}) {
      if (present.findChannel(name) == nullptr) {
        throw InputError(file.string(), std::string("not a frame of Promenade: no channel ") + name);
      }
    }
    Imf::FrameBuffer buffer;
    // OpenEXR converts to the type that is asked for.
    const auto add = [&](const char* name, Imf::PixelType type, void* first, std::size_t stride) {
      const auto width = static_cast<std::size_t>(size.width);
      buffer.insert(name, Imf::Slice(type, static_cast<char*>(first), stride, stride * width));
    };
    const auto has = [&](const char* name) { return present.findChannel(name) != nullptr; };

    frame.radiance = RadianceMap(size);
    Rgb* rgb = frame.radiance.pixels().data();
    add("R", Imf::FLOAT, &rgb->r, sizeof(Rgb));
    add("G", Imf::FLOAT, &rgb->g, sizeof(Rgb));
    add("B", Imf::FLOAT, &rgb->b, sizeof(Rgb));
    if (has("Z")) {
      frame.depth = DepthMap(size);
      add("Z", Imf::FLOAT, frame.depth.pixels().data(), sizeof(float));
    }
    if (has("N.X") && has("N.Y") && has("N.Z")) {
      frame.normal = NormalMap(size);
      glm::vec3* normal = frame.normal.pixels().data();
      add("N.X", Imf::FLOAT, &normal->x, sizeof(glm::vec3));
      add("N.Y", Imf::FLOAT, &normal->y, sizeof(glm::vec3));
      add("N.Z", Imf::FLOAT, &normal->z, sizeof(glm::vec3));
    }
    if (has("Vector.X") && has("Vector.Y")) {
      frame.flowToNext = PixelFlow(size);
      glm::vec2* flow = frame.flowToNext.pixels().data();
      add("Vector.X", Imf::FLOAT, &flow->x, sizeof(glm::vec2));
      add("Vector.Y", Imf::FLOAT, &flow->y, sizeof(glm::vec2));
    }
    if (has("Item.ID")) {
      frame.item = ItemBuffer(size);
      add("Item.ID", Imf::UINT, frame.item.pixels().data(), sizeof(ItemId));
    }
    std::vector<float> sources;
    if (has("Source")) {
      sources.resize(size.area());
      add("Source", Imf::FLOAT, sources.data(), sizeof(float));
    }
    in.setFrameBuffer(buffer);
    in.readPixels(0, size.height - 1);

    if (has("Source")) {
      frame.source = SourceMap(size);
      for (std::size_t i = 0; i < sources.size(); ++i) {
        if (!(sources[i] >= 0.0f && sources[i] <= 6.0f)) {
          throw InputError(file.string(),
                           "channel Source: expected 0 to 6, found " + std::to_string(sources[i]));
        }
        frame.source.pixels()[i] = static_cast<SampleSource>(sources[i]);
      }
    }
    return frame;
  });
}

FrameMetadata readFrameMetadata(const fs::path& file) {
  return readingExr(file, [&] {
    const Imf::InputFile in(file.c_str(), 0);
    return metadataOf(in.header(), file);
  });
}

std::string frameFileName(int frame) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%06d.exr", frame);
  return name.data();
}

}  // namespace promenade::io
