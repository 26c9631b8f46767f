// Files made to break loaders. Each loads or is refused with one line, quickly and without taking memory.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/core/errors.h"
#include "src/scene/load.h"
#include "tests/shared_data.h"

namespace promenade {
namespace {

std::vector<std::filesystem::path> sceneFilesBelow(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (entry.is_regular_file() && (ending == ".gltf" || ending == ".glb")) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

double peakMebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// The refusal's message; nothing if the file loads.
std::optional<std::string> refusalOf(const std::filesystem::path& file) {
  try {
    static_cast<void>(loadScene(file));
    return std::nullopt;
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(HostileScenes, LoadOrAreRefusedWithOneLineInBoundedTimeAndMemory) {
  PROMENADE_NEEDS_SHARED("hostile");
  const auto files = sceneFilesBelow(tests::sharedPath("hostile"));
  EXPECT_GE(files.size(), 400u);
  const double before = peakMebibytes();
  for (const auto& file : files) {
    const auto start = std::chrono::steady_clock::now();
    std::optional<std::string> refusal;
    ASSERT_NO_THROW(refusal = refusalOf(file)) << file;
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_LT(seconds.count(), 5.0) << file;
    if (refusal) {
      EXPECT_EQ(refusal->find('\n'), std::string::npos) << *refusal;
      EXPECT_TRUE(refusal->find(file.filename().string()) != std::string::npos || refusal->size() > 100)
          << *refusal;
    }
  }
  // The largest file has 0.3 MB.
  EXPECT_LT(peakMebibytes() - before, 512.0);
}

// Codes of the validator that say that something points where nothing is.
constexpr std::array<std::string_view, 19> kUnsafe = {"UNRESOLVED_REFERENCE",
                                                      "BUFFER_VIEW_TOO_LONG",
                                                      "ACCESSOR_TOO_LONG",
                                                      "ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE",
                                                      "ACCESSOR_SMALL_BYTESTRIDE",
                                                      "ACCESSOR_INDEX_OOB",
                                                      "ACCESSOR_INVALID_FLOAT",
                                                      "NODE_LOOP",
                                                      "NODE_PARENT_OVERRIDE",
                                                      "SCENE_NON_ROOT_NODE",
                                                      "GLB_CHUNK_TOO_BIG",
                                                      "GLB_UNEXPECTED_END_OF_HEADER",
                                                      "GLB_UNEXPECTED_END_OF_CHUNK_HEADER",
                                                      "GLB_UNEXPECTED_END_OF_CHUNK_DATA",
                                                      "GLB_LENGTH_TOO_SMALL",
                                                      "GLB_LENGTH_MISMATCH",
                                                      "GLB_INVALID_MAGIC",
                                                      "GLB_UNEXPECTED_FIRST_CHUNK",
                                                      "GLB_DUPLICATE_CHUNK"};

/// Error codes of the validator's report beside the file; nothing if there is no report.
std::optional<std::vector<std::string>> reportedErrors(const std::filesystem::path& file) {
  std::ifstream stream(file.string() + ".report.json");
  if (!stream) {
    return std::nullopt;
  }
  std::vector<std::string> codes;
  const auto report = nlohmann::json::parse(stream);
  for (const auto& message : report.at("issues").at("messages")) {
    if (message.at("severity") == 0) {
      codes.push_back(message.at("code"));
    }
  }
  return codes;
}

TEST(HostileScenes, WithDanglingReferencesAreRefusedOrNotShown) {
  PROMENADE_NEEDS_SHARED("hostile/khronos-validator");
  int refused = 0;
  for (const auto& file : sceneFilesBelow(tests::sharedPath("hostile/khronos-validator"))) {
    const auto errors = reportedErrors(file);
    const bool unsafe = errors && std::any_of(errors->begin(), errors->end(), [](const std::string& code) {
                          return std::find(kUnsafe.begin(), kUnsafe.end(), code) != kUnsafe.end();
                        });
    if (!unsafe) {
      continue;
    }
    if (refusalOf(file)) {
      ++refused;
      continue;
    }
    // Data that the shown scene does not use are not read.
    EXPECT_TRUE(loadScene(file).meshes.empty()) << file;
    EXPECT_TRUE(file.string().find("_data/") != std::string::npos) << file;
  }
  EXPECT_GE(refused, 50);
}

TEST(HostileScenes, ThatTheValidatorFindsGoodLoad) {
  PROMENADE_NEEDS_SHARED("hostile/khronos-validator");
  // A type and a version that 2.0 does not have, a URI with a scheme, and data used from a buffer that has
  // none; tinygltf refuses indices without a buffer view.
  const std::array<std::string_view, 6> kRefused = {"accessor/unknown_type.gltf", "min_version_valid.gltf",
                                                    "non_relative_uri.gltf",      "mesh/valid.gltf",
                                                    "named_objects.gltf",         "unused_objects.gltf"};
  int loaded = 0;
  for (const auto& file : sceneFilesBelow(tests::sharedPath("hostile/khronos-validator"))) {
    const auto errors = reportedErrors(file);
    if (!errors || !errors->empty()) {
      continue;
    }
    const bool expected = std::any_of(kRefused.begin(), kRefused.end(),
                                      [&](std::string_view name) { return file.string().ends_with(name); });
    const auto refusal = refusalOf(file);
    EXPECT_EQ(refusal.has_value(), expected) << file << ": " << refusal.value_or("loads");
    loaded += refusal ? 0 : 1;
  }
  EXPECT_GE(loaded, 100);
}

}  // namespace
}  // namespace promenade
