// Many small damages to small scenes: each loads or is refused with one line. The seed is fixed, so that a
// failure repeats; --gtest_random_seed=N gives others.

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "src/core/errors.h"
#include "src/scene/describe.h"
#include "src/scene/load.h"
#include "tests/fuzz/scene_seeds.h"

namespace promenade {
namespace {

using nlohmann::json;
using Random = std::mt19937_64;

constexpr int kMutations = 600;  // for each of the two tests, however slow the machine

std::size_t below(Random& random, std::size_t limit) {
  return static_cast<std::size_t>(random() % limit);
}

/// Pointers to every value of the document but itself.
void collect(json& value, std::vector<json*>& found) {
  if (!value.is_structured()) {
    return;
  }
  for (json& member : value) {
    found.push_back(&member);
    collect(member, found);
  }
}

json interestingValue(Random& random) {
  static const std::array<const char*, 22> kValues = {"0",
                                                      "1",
                                                      "-1",
                                                      "2",
                                                      "3",
                                                      "255",
                                                      "65536",
                                                      "2147483647",
                                                      "4294967295",
                                                      "4294967296",
                                                      "9007199254740991",
                                                      "18446744073709551615",
                                                      "-9223372036854775808",
                                                      "0.5",
                                                      "1e300",
                                                      "-1e-300",
                                                      "null",
                                                      "true",
                                                      "\"\"",
                                                      "[]",
                                                      "{}",
                                                      "[[]]"};
  return json::parse(kValues[below(random, kValues.size())]);
}

/// Replaces, removes or copies a few values.
json mutated(json document, Random& random) {
  const std::size_t changes = 1 + below(random, 3);
  for (std::size_t i = 0; i < changes; ++i) {
    std::vector<json*> values;
    collect(document, values);
    json& target = *values[below(random, values.size())];
    switch (below(random, 4)) {
      case 0:
        target = interestingValue(random);
        break;
      case 1:
        if (target.is_structured() && !target.empty()) {
          target.erase(std::next(target.begin(), static_cast<std::ptrdiff_t>(below(random, target.size()))));
        } else if (target.is_number()) {
          target = target.get<double>() + (below(random, 2) == 0 ? 1.0 : -1.0);
        }
        break;
      case 2:
        target = json(*values[below(random, values.size())]);
        break;
      default:
        if (target.is_array() && !target.empty()) {
          target.push_back(json(target[below(random, target.size())]));
        } else {
          target = interestingValue(random);
        }
    }
  }
  return document;
}

std::string damaged(std::string bytes, Random& random) {
  const std::size_t changes = 1 + below(random, 4);
  for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t at = below(random, bytes.size());
    switch (below(random, 4)) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ (1u << below(random, 8)));
        break;
      case 2:
        bytes.erase(at, 1 + below(random, 16));
        break;
      default:
        bytes.resize(at);
    }
  }
  return bytes;
}

enum class Outcome { kLoaded, kRefused };

Outcome tryToLoad(const std::filesystem::path& file) {
  try {
    const Scene scene = loadScene(file);
    EXPECT_FALSE(describe(ensureLight(Scene{loadScene(file)})).empty());
    for (const Instance& instance : scene.instances) {
      EXPECT_LT(static_cast<std::size_t>(instance.mesh), scene.meshes.size());
    }
    return Outcome::kLoaded;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return Outcome::kRefused;
  }
}

/// Loads `kMutations` files of `next`; both outcomes must have been met.
template <class Next>
void hammer(const std::string& name, Next next) {
  const tests::TemporaryFolder folder;
  Random random(20240229u + static_cast<std::uint64_t>(GTEST_FLAG_GET(random_seed)));
  std::array<int, 2> outcomes{};
  for (int i = 0; i < kMutations; ++i) {
    const auto file = folder.write(name, next(random));
    SCOPED_TRACE("mutation " + std::to_string(i));
    Outcome outcome{};
    ASSERT_NO_THROW(outcome = tryToLoad(file));
    ++outcomes[static_cast<std::size_t>(outcome)];
  }
  EXPECT_GT(outcomes[0], 10);
  EXPECT_GT(outcomes[1], 10);
}

TEST(SceneFuzz, TheSeedLoadsAsItIs) {
  const tests::TemporaryFolder folder;
  const Scene scene = loadScene(folder.write("seed.gltf", tests::richScene().dump()));
  EXPECT_EQ(scene.instances.size(), 3u);  // two of the first mesh, one of the skinned mesh
  EXPECT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.images.size(), 1u);
}

TEST(SceneFuzz, DocumentsWithWrongValuesLoadOrAreRefused) {
  const json seed = tests::richScene();
  hammer("scene.gltf", [&](Random& random) { return mutated(seed, random).dump(); });
}

TEST(SceneFuzz, DamagedFilesLoadOrAreRefused) {
  const std::string text = tests::richScene().dump();
  const std::string glb = tests::asGlb(tests::richScene());
  hammer("scene.any", [&](Random& random) { return damaged(below(random, 2) == 0 ? text : glb, random); });
}

}  // namespace
}  // namespace promenade
