#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "src/core/errors.h"

namespace promenade::app {

/// The work is refused with an InputError of one line that contains `part`.
inline void expectRefused(const std::function<void()>& work, const std::string& part) {
  try {
    work();
    FAIL() << "expected an InputError with: " << part;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(part));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

}  // namespace promenade::app
