// A disk that fills up, in two ways: a limit on the size of files, which every user may set, and a small file
// system, which only the superuser may mount.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstring>
#include <functional>
#include <string>

#include "src/core/errors.h"
#include "src/io/exr_frame.h"
#include "src/io/json.h"
#include "src/io/png.h"
#include "src/io/video.h"
#include "tests/io/temp_folder.h"

namespace promenade::io {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using tests::messageOf;
using tests::noiseFrame;
using tests::TempFolder;

constexpr Size kNoiseSize{160, 120};  // 57600 noise bytes a frame: no codec gets several of them into 64 KB

class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    oldHandler_ = ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &oldLimit_);
    const rlimit limit{bytes, oldLimit_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &oldLimit_);
    ::signal(SIGXFSZ, oldHandler_);
  }

 private:
  rlimit oldLimit_{};
  sighandler_t oldHandler_ = SIG_DFL;
};

class SmallFileSystem {
 public:
  explicit SmallFileSystem(const fs::path& folder) : folder_(folder) {
    fs::create_directory(folder_);
    mounted_ = ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=64k") == 0;
    error_ = errno;
  }
  SmallFileSystem(const SmallFileSystem&) = delete;
  SmallFileSystem& operator=(const SmallFileSystem&) = delete;
  ~SmallFileSystem() {
    if (mounted_) ::umount(folder_.c_str());
  }
  [[nodiscard]] bool mounted() const { return mounted_; }
  [[nodiscard]] std::string reason() const { return std::strerror(error_); }

 private:
  fs::path folder_;
  bool mounted_ = false;
  int error_ = 0;
};

void writeNoisyFrame(const fs::path& folder) {
  FrameFile frame;
  frame.metadata.camera = Camera(Pose{}, 1.0, kNoiseSize);
  frame.radiance = RadianceMap(kNoiseSize);
  const EncodedMap noise = noiseFrame(kNoiseSize, 0);
  for (std::size_t i = 0; i < kNoiseSize.area(); ++i) frame.radiance.pixels()[i] = noise.pixels()[i] * 3.3f;
  writeFrame(folder / "000000.exr", frame);
}

void writeVideo(const fs::path& file) {
  VideoWriter video(file, kNoiseSize, {25, 1});
  for (int i = 0; i < 40; ++i) video.write(noiseFrame(kNoiseSize, i));
  video.finish();
}

void writeEverywhere(const fs::path& folder, const std::string& reason) {
  const auto expectFull = [&](const std::function<void()>& write) {
    EXPECT_THAT(messageOf<CannotContinue>(write), HasSubstr(reason));
  };
  expectFull([&] { writeNoisyFrame(folder); });
  expectFull([&] { write8bit(folder / "a.png", noiseFrame({300, 300}, 0)); });
  expectFull([&] { writeTextFile(folder / "a.txt", std::string(100000, 'x')); });
  for (const char* name : {"a.mp4", "a.mkv", "a.webm", "a.gif"})
    expectFull([&] { writeVideo(folder / name); });
}

TEST(DiskFull, AtTheLimitOfFileSizesIsCannotContinueAndLeavesNothing) {
  const TempFolder folder;
  {
    const FileSizeLimit limit(32768);
    writeEverywhere(folder.path(), "File too large");
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(DiskFull, OnASmallFileSystemIsCannotContinueAndLeavesNothing) {
  const TempFolder folder;
  const SmallFileSystem small(folder / "small");
  if (!small.mounted()) {
    GTEST_SKIP() << "SKIPPED: cannot mount a small file system here (" << small.reason() << ")";
  }
  writeEverywhere(folder / "small", "No space left on device");
  EXPECT_TRUE(fs::is_empty(folder / "small"));
}

}  // namespace
}  // namespace promenade::io
