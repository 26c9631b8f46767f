#pragma once
// A folder of its own for each test, gone afterwards.

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "src/core/image.h"

namespace promenade::tests {

class TempFolder {
 public:
  TempFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "promenade-io-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
    path_ = name;
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  /// Everything in it, hidden files included.
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      found.push_back(entry.path().filename());
    return found;
  }

 private:
  std::filesystem::path path_;
};

inline std::string bytesOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void writeBytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// The message of the exception of type `Error` that `action` throws; a failure of the test if it throws
/// none.
template <class Error, class Action>
std::string messageOf(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos)
        << "more than one line: " << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

/// Code values k/255 that differ from pixel to pixel, channel to channel and frame to frame, in a
/// reproducible way.
inline EncodedMap noiseFrame(Size size, int frame) {
  EncodedMap image(size);
  std::uint32_t state = 12345U + 977U * static_cast<std::uint32_t>(frame);
  for (Rgb& code : image.pixels()) {
    for (int i = 0; i < 3; ++i) {
      state = state * 1664525U + 1013904223U;
      code[i] = static_cast<float>(state >> 24) / 255.0f;
    }
  }
  return image;
}

/// A smooth picture that moves by a pixel a frame.
inline EncodedMap gradientFrame(Size size, int frame) {
  EncodedMap image(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float u = static_cast<float>((x + frame) % 256) / 255.0f;
      const float v = static_cast<float>(y % 256) / 255.0f;
      image(x, y) = Rgb(u, v, 0.5f);
    }
  }
  return image;
}

}  // namespace promenade::tests
