#include "src/io/foreign_frame.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfFramesPerSecond.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <string_view>

#include "src/core/errors.h"
#include "src/io/exr_frame.h"
#include "src/io/exr_reading_internal.h"
#include "src/io/image_limits.h"

namespace promenade::io {
namespace {

namespace fs = std::filesystem;

/// Renderers write this far or farther where they hit nothing (Blender: 1e10).
constexpr float kNothingHit = 1e9f;

/// `name` itself, else the first channel of a layer that ends so; empty if there is none.
std::string channelNamed(const Imf::ChannelList& channels, const std::string& name,
                         std::string_view inLayer) {
  if (channels.findChannel(name) != nullptr) return name;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    if (std::string_view(channel.name()).ends_with(inLayer)) return channel.name();
  }
  return {};
}

// The reverse of exr_frame.cpp's worldToCamera() and worldToNdc().
Camera cameraOf(const Imf::Header& header, Size size, const fs::path& file) {
  const Imath::M44d toCamera(Imf::worldToCamera(header));
  const Imath::M44d project = toCamera.inverse() * Imath::M44d(Imf::worldToNDC(header));
  Pose pose;
  for (int i = 0; i < 3; ++i) {
    pose.worldFromCamera[0][i] = toCamera[i][0];
    pose.worldFromCamera[1][i] = toCamera[i][1];
    pose.worldFromCamera[2][i] = -toCamera[i][2];
  }
  // Single precision and scaled cameras: back to a rotation.
  glm::dmat3& axes = pose.worldFromCamera;
  axes[2] = glm::normalize(axes[2]);
  axes[0] = glm::normalize(axes[0] - glm::dot(axes[0], axes[2]) * axes[2]);
  axes[1] = glm::cross(axes[2], axes[0]);
  const Imath::M44d toWorld = toCamera.inverse();
  pose.eye = {toWorld[3][0], toWorld[3][1], toWorld[3][2]};

  // Divided by w, which grows by project[2][3] a metre along the axis.
  const double w = project[2][3];
  const double focalX = project[0][0] / w * size.width;
  const double focalY = -project[1][1] / w * size.height;
  const double centreX = project[2][0] / w;
  const double centreY = project[2][1] / w;
  const bool perspective = std::isfinite(focalX) && std::isfinite(focalY) && focalX > 0.0 && focalY > 0.0;
  if (!perspective || std::abs(focalX / focalY - 1.0) > 1e-3) {
    throw InputError(file.string(), "worldToNDC: expected a perspective with square pixels");
  }
  if (std::abs(centreX - 0.5) * size.width > 0.5 || std::abs(centreY - 0.5) * size.height > 0.5) {
    throw InputError(file.string(), "worldToNDC: expected the view axis through the middle of the image");
  }
  return Camera(pose, 2.0 * std::atan(0.5 * size.height / focalY), size);
}

bool isOwn(const Imf::Header& header) {
  return header.findTypedAttribute<Imf::M33dAttribute>("promenade:cameraAxes") != nullptr;
}

Size sizeOf(const Imf::Header& header, const fs::path& file) {
  const auto window = header.dataWindow();
  if (window.min != Imath::V2i(0, 0) || window != header.displayWindow()) {
    throw InputError(file.string(), "expected a data window equal to the display window");
  }
  const Size size{window.max.x + 1, window.max.y + 1};
  requireReasonableSize(file, size);
  return size;
}

void checkDepth(DepthMap& depth, const fs::path& file) {
  for (float& z : depth.pixels()) {
    if (std::isnan(z) || z >= kNothingHit) z = std::numeric_limits<float>::infinity();
    if (!(z > 0.0f)) {
      throw InputError(file.string(), "channel Z: expected metres above 0, found " + std::to_string(z));
    }
  }
}

}  // namespace

ForeignCamera readForeignCamera(const fs::path& file) {
  return readingExr(file, [&]() -> ForeignCamera {
    const Imf::InputFile in(file.c_str(), 0);
    const Imf::Header& header = in.header();
    if (isOwn(header)) {
      const FrameMetadata own = readFrameMetadata(file);
      return {own.camera, own.framesPerSecond > 0.0 ? std::optional(own.framesPerSecond) : std::nullopt};
    }
    ForeignCamera found;
    if (Imf::hasWorldToCamera(header) && Imf::hasWorldToNDC(header)) {
      found.camera = cameraOf(header, sizeOf(header, file), file);
    }
    if (Imf::hasFramesPerSecond(header)) {
      const Imf::Rational rate = Imf::framesPerSecond(header);
      if (rate.n > 0 && rate.d > 0) found.framesPerSecond = static_cast<double>(rate.n) / rate.d;
    }
    return found;
  });
}

ForeignFrame readForeignFrame(const fs::path& file) {
  return readingExr(file, [&]() -> ForeignFrame {
    Imf::InputFile in(file.c_str(), 0);
    const Imf::Header& header = in.header();
    if (isOwn(header)) {
      FrameFile own = readFrame(file);
      if (own.depth.empty()) throw InputError(file.string(), "expected a channel Z");
      checkDepth(own.depth, file);
      return {std::move(own.radiance), std::move(own.depth), std::move(own.normal), std::move(own.item)};
    }
    const Size size = sizeOf(header, file);
    const Imf::ChannelList& channels = header.channels();
    const std::string z = channelNamed(channels, "Z", "Depth.Z");
    const std::string r = channelNamed(channels, "R", "Combined.R");
    const std::string g = channelNamed(channels, "G", "Combined.G");
    const std::string b = channelNamed(channels, "B", "Combined.B");
    if (r.empty() || g.empty() || b.empty()) throw InputError(file.string(), "expected channels R, G, B");
    if (z.empty()) throw InputError(file.string(), "expected a channel Z");
    if (channels.findChannel(z)->type == Imf::HALF) {
      throw InputError(file.string(), "channel Z: expected 32-bit floats, found half, too coarse to warp by");
    }
    ForeignFrame frame;
    frame.radiance = RadianceMap(size);
    frame.depth = DepthMap(size);
    Imf::FrameBuffer buffer;
    const auto add = [&](const std::string& name, float* first, std::size_t stride) {
      buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(first), stride,
                                     stride * static_cast<std::size_t>(size.width)));
    };
    Rgb* rgb = frame.radiance.pixels().data();
    add(r, &rgb->r, sizeof(Rgb));
    add(g, &rgb->g, sizeof(Rgb));
    add(b, &rgb->b, sizeof(Rgb));
    add(z, frame.depth.pixels().data(), sizeof(float));
    in.setFrameBuffer(buffer);
    in.readPixels(0, size.height - 1);
    checkDepth(frame.depth, file);
    return frame;
  });
}

}  // namespace promenade::io
