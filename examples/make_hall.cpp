// make_hall FOLDER: writes the exhibition hall as glTF.

#include <cstdio>
#include <exception>
#include <string_view>

#include "examples/hall/hall.h"

int main(int argc, char** argv) {
  const bool help = argc == 2 && (std::string_view(argv[1]) == "--help" || std::string_view(argv[1]) == "-h");
  if (argc != 2 || help) {
    std::fputs("usage: make_hall FOLDER\nWrites hall.gltf, hall.bin and textures into FOLDER (about 6 MB).\n",
               help ? stdout : stderr);
    return help ? 0 : 2;
  }
  try {
    const auto [triangles, bytes] = promenade::hall::writeHall(argv[1]);
    std::printf("%s/hall.gltf: %zu triangles, %.1f MB\n", argv[1], triangles,
                static_cast<double>(bytes) / 1e6);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_hall: %s\n", error.what());
    return 3;
  }
  return 0;
}
