// Damaged files end in an InputError or are read; nothing else.

#include <cmath>
#include <random>

#include "paths/read_path.h"
#include "tests/paths/near.h"

namespace promenade::paths {
namespace {

const std::string kPromenade =
    R"({"fps":5,"up":[0,1,0],"interpolation":"catmull-rom","speed":"constant","keys":[
{"time":0,"eye":[0,0,0],"target":[0,0,-9],"fov":40},{"time":1.5,"eye":[4,0,0],"rotation":[0,0.6,0,0.8]},
{"time":3,"eye":[4,1,7],"target":[4,0,-9]}]})";
const std::string kNerfstudio =
    R"({"fps":3,"camera_type":"perspective","camera_path":[
{"camera_to_world":[1,0,0,4,0,1,0,5,0,0,1,6,0,0,0,1],"fov":50},
{"camera_to_world":[0,0,2,1,0,2,0,2,-2,0,0,3,0,0,0,1],"fov":60}]})";
const std::string kTum = "# time\n0 1 2 3 0 0 0 1\n0.5 1 2 4 0 0.6 0 0.8\n1.5 2 2 4 0 1 0 0\n";

std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  static const std::string kAlphabet = "0123456789-+.eE[]{}:,\" \n#nuli\t";
  for (std::size_t k = 1 + below(4); k > 0 && !text.empty(); --k) {
    const std::size_t at = below(text.size());
    switch (below(5)) {
      case 0:
        text[at] = kAlphabet[below(kAlphabet.size())];
        break;
      case 1:
        text.insert(at, 1, kAlphabet[below(kAlphabet.size())]);
        break;
      case 2:
        text.erase(at, 1 + below(6));
        break;
      case 3:
        text[at] = static_cast<char>(random());
        break;
      default:
        text.insert(at, text.substr(below(text.size()), 1 + below(40)));
    }
  }
  return text;
}

TEST(ParsePath, OfDamagedTextIsAPathOrOneClearError) {
  std::mt19937 random(20260131);
  int read = 0;
  for (int round = 0; round < 4000; ++round) {
    for (const std::string& whole : {kPromenade, kNerfstudio, kTum}) {
      const std::string text = mutated(whole, random);
      try {
        const CameraPath path = parsePath(text, "walk", {});
        ASSERT_GE(path.frameCount(), 1);
        for (const PathFrame& frame : path.frames) {
          ASSERT_TRUE(std::isfinite(glm::length(frame.pose.eye))) << text;
          ASSERT_NEAR(glm::determinant(frame.pose.worldFromCamera), 1.0, 1e-6) << text;
          ASSERT_TRUE(frame.verticalFieldOfView > 0.0 && frame.verticalFieldOfView < 3.14159) << text;
        }
        ++read;
      } catch (const InputError& error) {
        ASSERT_EQ(std::string(error.what()).rfind("walk: ", 0), 0u) << error.what();
      }
    }
  }
  EXPECT_GT(read, 200);  // some mutations do no harm: the test does look at paths
}

TEST(ParsePath, OfDeepNestingEndsQuickly) {
  expectRefused([] { (void)parsePath(std::string(1'000'000, '['), "walk", {}); }, "walk: expected JSON");
  expectRefused(
      [] {
        (void)parsePath(R"({"keys":)" + std::string(500'000, '[') + std::string(500'000, ']') + "}", "walk",
                        {});
      },
      "walk");
}

}  // namespace
}  // namespace promenade::paths
