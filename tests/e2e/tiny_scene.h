#pragma once
// Scenes of a few triangles for tests of the whole program, and a folder for each test.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/e2e/process.h"

namespace promenade::e2e {

enum class With { kAll, kNoCamera, kNoAnimation, kNoLight, kNoMesh };

/// Writes NAME.gltf and NAME.bin into `folder`: a quad with a checkered pair of colours in front of a camera
/// that moves 1 m sideways in `seconds`, lit by a directional light. Returns the .gltf.
std::filesystem::path writeScene(const std::filesystem::path& folder, const std::string& name, With with,
                                 float seconds = 1.0f);

void writeText(const std::filesystem::path& file, const std::string& text);

/// A folder that is empty at the start of each test and gone after it.
class InFolder : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
};

/// The program refused its input: status 2 and one clear line that contains `part`.
void expectRefused(const Outcome& outcome, const std::string& part);
void expectDone(const Outcome& outcome);

/// Every file below `folder` is whole: no temporaries, and every rendered frame can be read.
void expectOnlyWholeFiles(const std::filesystem::path& folder);

/// Returns once a running job has written a few frames.
void waitForFrames(const std::filesystem::path& folder);

/// Frames, video and report of two rendered folders are the same bit for bit, but for what depends on the
/// clock, the machine and the command line: seconds, memory, the folder.
void expectSameResult(const std::filesystem::path& folder, const std::filesystem::path& reference);

/// Number of frames/*.exr in a rendered folder.
int framesIn(const std::filesystem::path& folder);

}  // namespace promenade::e2e
