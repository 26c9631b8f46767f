// libFuzzer target (option PROMENADE_FUZZERS, needs clang): scene_fuzzer CORPUS_FOLDER

#include <cstddef>
#include <cstdint>
#include <string>

#include "src/core/errors.h"
#include "src/scene/describe.h"
#include "src/scene/load.h"
#include "tests/scene/gltf_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const promenade::tests::TemporaryFolder folder;
  const auto file = folder.write("scene.gltf", std::string(reinterpret_cast<const char*>(data), size));
  try {
    static_cast<void>(promenade::describe(promenade::loadScene(file)));
  } catch (const promenade::InputError&) {
    // A refusal is a good answer; anything else ends the fuzzer.
  }
  return 0;
}
