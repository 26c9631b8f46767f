// Framed pictures and the mirror.

#include <array>

#include "examples/hall/furnishings.h"
#include "examples/hall/layout.h"
#include "examples/hall/names.h"
#include "examples/hall/paintings.h"

namespace promenade::hall {
namespace {

/// A rectangle about the origin in z = 0, facing +Z, with the whole image on it.
Surface canvas(double width, double height) {
  const double x = 0.5 * width, y = 0.5 * height;
  Surface s;
  s.addQuad({-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0});
  s.texCoords = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  return s;
}

/// A carved frame around it: a slip, a hollow, a bead and a raised outer edge, `breadth` wide.
Surface pictureFrame(double width, double height, double breadth) {
  std::vector<glm::dvec2> profile{{-0.004, 0.0}, {-0.004, 0.012}, {0.10, 0.012}, {0.13, 0.028},
                                  {0.22, 0.022}, {0.36, 0.030},   {0.50, 0.052}, {0.62, 0.080},
                                  {0.68, 0.082}, {0.70, 0.094},   {0.76, 0.104}, {0.86, 0.104},
                                  {0.93, 0.092}, {0.97, 0.070},   {1.0, 0.040},  {1.0, -0.05}};
  for (glm::dvec2& p : profile) p.x *= breadth;
  return frame(width, height, profile);
}

struct Hanging {
  const char* name;
  Motif motif;
  double width, height;
  glm::dvec3 centre;
  double yawDegrees;
};

}  // namespace

void addPictures(GltfWriter& gltf, const Palette& palette) {
  // A little off the wall, where the back of the frame is.
  constexpr double kOnWall = kWallX - 0.05, kEnd = kHalfLength - 0.05;
  constexpr double kRight = -90.0;
  const std::array<Hanging, 9> hangings{{
      {"mountains", Motif::kMountains, 2.30, 1.55, {kOnWall, 2.16, 7.2}, kRight},
      {"still-life", Motif::kStillLife, 1.10, 0.90, {kOnWall, 2.45, 0.75}, kRight},
      {"birches", Motif::kBirches, 1.00, 1.30, {kOnWall, 2.45, -0.75}, kRight},
      {"color-fields", Motif::kColorFields, 1.50, 1.90, {kOnWall, 2.60, -3.6}, kRight},
      {"sea", Motif::kSea, 1.80, 1.20, {kOnWall, 2.50, -7.2}, kRight},
      {"poppies", Motif::kPoppies, 1.70, 1.20, {5.85, 2.40, -kEnd}, 0.0},
      {"circles", Motif::kCircles, 1.50, 1.50, {-5.85, 2.40, -kEnd}, 0.0},
      {"grid", Motif::kGrid, 1.40, 1.40, {5.85, 2.40, kEnd}, 180.0},
      {"sea-again", Motif::kSea, 1.70, 1.15, {-5.85, 2.40, kEnd}, 180.0},
  }};
  for (const Hanging& h : hangings) {
    const int pixels = h.width > 2.0 ? 640 : 416;
    const std::string name = named("painting", h.name);
    const ImageId image = gltf.addImage(name, painting(h.motif, h.width / h.height, pixels));
    const MaterialId material = gltf.addMaterial({.name = name, .baseColorImage = image, .roughness = 0.65});
    const Placement at{.translation = h.centre, .yawDegrees = h.yawDegrees};
    gltf.addNode(name, gltf.addMesh(name, canvas(h.width, h.height), material), at);
    const std::string frameName = named("frame", h.name);
    const double breadth = h.width > 2.0 ? 0.20 : 0.14;
    gltf.addNode(frameName, gltf.addMesh(frameName, pictureFrame(h.width, h.height, breadth), palette.gilt),
                 at);
  }
  constexpr double kMirrorWidth = 1.5, kMirrorHeight = 2.5;
  const Placement mirror{.translation = {kOnWall, 2.5, 3.6}, .yawDegrees = kRight};
  gltf.addNode("mirror", gltf.addMesh("mirror", canvas(kMirrorWidth, kMirrorHeight), palette.mirror), mirror);
  gltf.addNode("frame-mirror",
               gltf.addMesh("frame-mirror", pictureFrame(kMirrorWidth, kMirrorHeight, 0.16), palette.gilt),
               mirror);
}

}  // namespace promenade::hall
