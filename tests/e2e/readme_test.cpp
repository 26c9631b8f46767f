// What the README tells a newcomer to type about `promenade compare`, typed as it is written there, into a
// shell, in a folder with files of these names.

#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/e2e/tiny_scene.h"

namespace promenade::e2e {
namespace {

namespace fs = std::filesystem;

/// The README's lines that begin with `promenade compare`, without their remarks.
std::vector<std::string> commandsOfReadme() {
  std::ifstream readme(fs::path(PROMENADE_SOURCE_DIR) / "README.md");
  const std::string indent = "    ";
  std::vector<std::string> commands;
  for (std::string line; std::getline(readme, line);) {
    if (line.rfind(indent + "promenade compare ", 0) != 0) continue;
    commands.push_back(line.substr(indent.size(), line.find(" #") - indent.size()));
  }
  return commands;
}

/// A picture of 64 x 48 pixels whose right half is brighter in `shade`.
void writePicture(const fs::path& file, float shade) {
  fs::create_directories(file.parent_path());
  std::vector<float> pixels;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) pixels.insert(pixels.end(), 3, x < 32 ? 0.3f : shade);
  }
  const OIIO::TypeDesc type = file.extension() == ".exr" ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8;
  const auto out = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(out && out->open(file.string(), OIIO::ImageSpec(64, 48, 3, type))) << file;
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
  ASSERT_TRUE(out->close());
}

class Readme : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    writePicture(at("new.png"), 0.9f);
    writePicture(at("old.png"), 0.5f);
    writePicture(at("hero.png"), 1.0f);
    for (const char* name : {"0000", "0001", "0002"}) {
      writePicture(folder_ / "v2" / (std::string(name) + ".exr"), 0.9f);
      writePicture(folder_ / "v1" / (std::string(name) + ".exr"), 0.5f);
      writePicture(folder_ / "out/mine/frames" / ("00" + std::string(name) + ".exr"), 0.9f);
      writePicture(folder_ / "out/reference/frames" / ("00" + std::string(name) + ".exr"), 0.5f);
    }
    expectDone(run({"encode", at("v2"), at("new.mp4"), "--exposure", "0", "--quiet"}));
    expectDone(run({"encode", at("v1"), at("old.mp4"), "--exposure", "0", "--quiet"}));
  }

  /// Exit status of a line typed in the folder; what it prints on stdout goes to `out`.
  [[nodiscard]] int typed(const std::string& line) const {
    const std::string shell = "cd '" + folder_.string() + "' && PATH='" +
                              fs::path(PROMENADE_BINARY).parent_path().string() + "':\"$PATH\" && " + line +
                              " > stdout.txt 2> stderr.txt";
    const int state = std::system(shell.c_str());
    return WIFEXITED(state) ? WEXITSTATUS(state) : -1;
  }
  [[nodiscard]] std::string contents(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
};

TEST_F(Readme, CompareIsTypedAsItIsWritten) {
  const std::vector<std::string> commands = commandsOfReadme();
  ASSERT_GE(commands.size(), 5u);
  for (const std::string& command : commands) {
    SCOPED_TRACE(command);
    const int status = typed(command);
    // Half of every picture differs plainly: above any limit.
    const bool hasLimit = command.find("--fail-above") != std::string::npos;
    EXPECT_EQ(status, hasLimit ? 1 : 0) << contents("stderr.txt");
    const bool isList = command.find("'?'") != std::string::npos;
    EXPECT_THAT(contents("stdout.txt"), testing::HasSubstr(isList ? "crt-100" : "visibl"));
  }
  EXPECT_TRUE(fs::exists(at("differences/000000.png")));
  const std::string table = contents("table.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4);  // a head and three frames
}

}  // namespace
}  // namespace promenade::e2e
