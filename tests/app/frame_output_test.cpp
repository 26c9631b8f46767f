#include "src/app/frame_output.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>

#include "src/core/errors.h"

namespace promenade::app {
namespace {

class FrameFilesTest : public testing::Test {
 protected:
  FrameFilesTest()
      : path_(std::filesystem::path(testing::TempDir()) /
              ("promenade-" + std::to_string(getpid()) + "-" +
               testing::UnitTest::GetInstance()->current_test_info()->name())),
        folder_(path_, "job", Existing::kOverwrite) {
    walk_.frames.assign(3, {Pose{}, 1.0});
  }
  ~FrameFilesTest() override { std::filesystem::remove_all(path_); }

  [[nodiscard]] FrameFiles files() const { return {folder_, walk_, "scene", "job"}; }
  static walkthrough::FinishedFrame frame(int index) {
    walkthrough::FinishedFrame frame;
    frame.index = index;
    frame.radiance = RadianceMap(2, 1, Rgb(static_cast<float>(index)));
    return frame;
  }
  /// No file can take the place of a folder.
  void block(int index) const { std::filesystem::create_directory(folder_.frame(index)); }

  std::filesystem::path path_;
  OutputFolder folder_;
  paths::CameraPath walk_;
};

TEST_F(FrameFilesTest, AreAllThereWhenTheyAreFinished) {
  FrameFiles files = this->files();
  for (int i = 0; i < 3; ++i) {
    files.write(frame(i));
    if (i > 0) {
      EXPECT_TRUE(std::filesystem::exists(folder_.frame(i - 1))) << "one is written at a time";
    }
  }
  files.finish();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(io::readFrame(folder_.frame(i)).radiance(1, 0).r, i) << i;
}

TEST_F(FrameFilesTest, SayAtTheNextFrameThatOneCouldNotBeWritten) {
  block(0);
  FrameFiles files = this->files();
  files.write(frame(0));
  EXPECT_THROW(files.write(frame(1)), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder_.frame(1)));
}

TEST_F(FrameFilesTest, SayAtTheEndThatTheLastCouldNotBeWritten) {
  block(2);
  FrameFiles files = this->files();
  files.write(frame(1));
  files.write(frame(2));
  EXPECT_THROW(files.finish(), InputError);
  EXPECT_NO_THROW(files.finish());
  EXPECT_TRUE(std::filesystem::exists(folder_.frame(1)));
}

TEST_F(FrameFilesTest, WriteToTheEndWhatWasBegunThoughTheWalkFails) {
  try {
    FrameFiles files = this->files();
    files.write(frame(0));
    throw Interrupted();
  } catch (const Interrupted&) {
  }
  EXPECT_EQ(io::readFrame(folder_.frame(0)).metadata.frame, 0);
}

}  // namespace
}  // namespace promenade::app
