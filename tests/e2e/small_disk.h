#pragma once
// A file system that is soon full.

#include <sys/mount.h>

#include <filesystem>
#include <string>
#include <utility>

namespace promenade::e2e {

/// In memory, of `size` ("128k"), while it lives; false if there cannot be one here.
class SmallDisk {
 public:
  SmallDisk(std::string folder, const std::string& size) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
    mounted_ = mount("tmpfs", folder_.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (mounted_) umount(folder_.c_str());
  }
  explicit operator bool() const { return mounted_; }

  /// As if somebody had made room.
  [[nodiscard]] bool resize(const std::string& size) const {
    return mount("tmpfs", folder_.c_str(), "tmpfs", MS_REMOUNT, ("size=" + size).c_str()) == 0;
  }

 private:
  std::string folder_;
  bool mounted_ = false;
};

}  // namespace promenade::e2e
