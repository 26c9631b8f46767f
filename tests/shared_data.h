#pragma once
// Data that lies beside the checkout and is not part of it. Tests that need it skip, loudly, where it is
// absent.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace promenade::tests {

inline std::filesystem::path sharedPath(const std::string& relative) {
  return std::filesystem::path(PROMENADE_SOURCE_DIR) / ".." / "shared" / relative;
}

}  // namespace promenade::tests

#define PROMENADE_NEEDS_SHARED(relative)                                                        \
  if (!std::filesystem::exists(promenade::tests::sharedPath(relative))) {                       \
    GTEST_SKIP() << "SKIPPED: test data is absent: " << promenade::tests::sharedPath(relative); \
  }
