#include "src/core/fnv1a.h"

#include <gtest/gtest.h>

#include <string_view>

namespace promenade {
namespace {

std::uint64_t hashOf(std::string_view text) {
  return fnv1a(std::as_bytes(std::span(text)));
}

TEST(Fnv1a, GivesThePublishedValues) {
  // http://www.isthe.com/chongo/src/fnv/test_fnv.c
  EXPECT_EQ(hashOf(""), 0xcbf29ce484222325u);
  EXPECT_EQ(hashOf("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(hashOf("foobar"), 0x85944171f73967e8u);
}

}  // namespace
}  // namespace promenade
