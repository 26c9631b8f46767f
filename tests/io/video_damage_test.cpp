// Videos that are not whole.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/core/errors.h"
#include "src/io/video.h"
#include "tests/io/temp_folder.h"

namespace promenade::io {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using tests::bytesOf;
using tests::messageOf;
using tests::noiseFrame;
using tests::TempFolder;
using tests::writeBytes;

constexpr Size kVideoSize{64, 48};

std::string videoBytes(const std::string& name) {
  const TempFolder folder;
  VideoWriter writer(folder / name, kVideoSize, {25, 1});
  for (int i = 0; i < 20; ++i) writer.write(noiseFrame(kVideoSize, i));
  writer.finish();
  return bytesOf(folder / name);
}

void readAll(const fs::path& file) {
  VideoReader reader(file);
  while (reader.next()) {
  }
}

class CutVideo : public testing::TestWithParam<const char*> {};

TEST_P(CutVideo, IsRefusedWhereverItIsCut) {
  const std::string whole = videoBytes(GetParam());
  const TempFolder folder;
  for (const double part : {0.0, 0.001, 0.05, 0.3, 0.5, 0.8, 0.95}) {
    const auto size = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
    writeBytes(folder / GetParam(), whole.substr(0, size));
    const std::string message = messageOf<InputError>([&] { readAll(folder / GetParam()); });
    EXPECT_THAT(message, HasSubstr(GetParam())) << "cut at " << part;
  }
}

INSTANTIATE_TEST_SUITE_P(OfEveryFormat, CutVideo, testing::Values("v.mp4", "v.mkv", "v.webm", "v.gif"),
                         [](const auto& test) { return std::string(test.param).substr(2); });

TEST(DamagedVideo, Ffv1FindsAnyFlippedByteInAFrame) {
  const std::string whole = videoBytes("v.mkv");
  const TempFolder folder;
  for (const double place : {0.3, 0.55, 0.8}) {
    std::string damaged = whole;
    auto& byte = damaged[static_cast<std::size_t>(place * static_cast<double>(whole.size()))];
    byte = static_cast<char>(byte ^ 0x55);
    writeBytes(folder / "v.mkv", damaged);
    EXPECT_THROW(readAll(folder / "v.mkv"), InputError) << "at " << place;
  }
}

TEST(DamagedVideo, WhatIsNoVideoIsRefused) {
  const TempFolder folder;
  EXPECT_THAT(messageOf<InputError>([&] { VideoReader(folder / "absent.mp4"); }), HasSubstr("no such file"));
  EXPECT_THAT(messageOf<InputError>([&] { VideoReader{folder.path()}; }), HasSubstr("found a folder"));
  writeBytes(folder / "text.mp4", "#EXTM3U\n#EXTINF:1,\n/etc/passwd\n");
  EXPECT_THAT(messageOf<InputError>([&] { VideoReader(folder / "text.mp4"); }),
              HasSubstr("cannot read as a video"));
}

}  // namespace
}  // namespace promenade::io
