#include "src/app/foreign_frames.h"

#include <cmath>
#include <string>
#include <utility>

#include "ibr/depth_normals.h"
#include "src/core/errors.h"
#include "src/io/foreign_frame.h"

namespace promenade::app {
namespace {

// The metric must find what may not be warped: nothing is known of materials.
ItemBuffer oneItem(const DepthMap& depth) {
  ItemBuffer item(depth.size());
  for (std::size_t i = 0; i < depth.pixels().size(); ++i) {
    item.pixels()[i] = std::isfinite(depth.pixels()[i]) ? 1 : kNoItem;
  }
  return item;
}

}  // namespace

Frame frameFrom(const std::filesystem::path& file, const Camera& camera) {
  io::ForeignFrame read = io::readForeignFrame(file);
  const Size size = camera.size();
  if (read.radiance.size() != size) {
    throw InputError(file.string(),
                     "expected " + toString(size) + " samples, found " + toString(read.radiance.size()));
  }
  Frame frame;
  frame.visibility.camera = camera;
  frame.visibility.normal = read.normal.empty() ? ibr::normalsOf(read.depth, camera) : std::move(read.normal);
  frame.visibility.item = read.item.empty() ? oneItem(read.depth) : std::move(read.item);
  frame.visibility.depth = std::move(read.depth);
  frame.diffuse = std::move(read.radiance);
  frame.viewDependent = RadianceMap(size);
  frame.source = SourceMap(size, SampleSource::kTraced);
  return frame;
}

}  // namespace promenade::app
