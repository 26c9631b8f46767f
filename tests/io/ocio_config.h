#pragma once
// A small OpenColorIO config whose views can be worked out by hand.

#include <filesystem>
#include <fstream>

namespace promenade::tests {

/// Writes FOLDER/config.ocio and its table, and returns the former. Display "Screen", view "Swapped": red and
/// green change places, blue is halved, then code values rise straight from (0, 0) by (0.5, 0.8) to (1, 1)
/// and stay there. View "Plain" of "Screen" and of "Wall": radiance as it is. Role scene_linear: the
/// radiance.
inline std::filesystem::path writeOcioConfig(const std::filesystem::path& folder) {
  std::ofstream(folder / "rise.spi1d")
      << "Version 1\nFrom 0.0 1.0\nLength 3\nComponents 1\n{\n 0.0\n 0.8\n 1.0\n}\n";
  std::ofstream(folder / "config.ocio") << R"(ocio_profile_version: 2
search_path: .
strictparsing: true
roles:
  default: radiance
  scene_linear: radiance
displays:
  Screen:
    - !<View> {name: Swapped, colorspace: swapped}
    - !<View> {name: Plain, colorspace: radiance}
  Wall:
    - !<View> {name: Plain, colorspace: radiance}
colorspaces:
  - !<ColorSpace>
    name: radiance
  - !<ColorSpace>
    name: halves
    to_scene_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: swapped
    from_scene_reference: !<GroupTransform>
      children:
        - !<MatrixTransform> {matrix: [0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}
        - !<FileTransform> {src: rise.spi1d, interpolation: linear}
)";
  return folder / "config.ocio";
}

}  // namespace promenade::tests
