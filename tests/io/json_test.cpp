#include "src/io/json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "src/core/errors.h"
#include "tests/io/temp_folder.h"

namespace promenade::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::bytesOf;
using tests::messageOf;
using tests::TempFolder;
using tests::writeBytes;

TEST(TextFile, ComesBackAsItWas) {
  const TempFolder folder;
  const std::string text("a\0b\r\n", 5);
  writeTextFile(folder / "a", text);
  EXPECT_EQ(readTextFile(folder / "a"), text);
}

TEST(TextFile, IsRefusedAboveTheLimitAndNotAtIt) {
  const TempFolder folder;
  writeBytes(folder / "a", std::string(1000, 'x'));
  EXPECT_EQ(readTextFile(folder / "a", 1000).size(), 1000U);
  EXPECT_THAT(messageOf<InputError>([&] { (void)readTextFile(folder / "a", 999); }),
              HasSubstr("at most 999 bytes"));
}

TEST(TextFile, IsARegularFile) {
  const TempFolder folder;
  EXPECT_THAT(messageOf<InputError>([&] { (void)readTextFile(folder / "absent"); }),
              HasSubstr("no such file"));
  EXPECT_THAT(messageOf<InputError>([&] { (void)readTextFile(folder.path()); }), HasSubstr("found a folder"));
  EXPECT_THAT(messageOf<InputError>([&] { (void)readTextFile("/dev/zero"); }),
              HasSubstr("expected a regular file"));
}

TEST(Json, ComesBackAndTheFileEndsWithANewLine) {
  const TempFolder folder;
  const nlohmann::json value = {{"b", 1}, {"a", {1.5, "x", nullptr}}};
  writeJson(folder / "a.json", value);
  EXPECT_EQ(readJson(folder / "a.json"), value);
  EXPECT_TRUE(bytesOf(folder / "a.json").ends_with("}\n"));
}

TEST(Json, OrderedKeysStayInOrder) {
  const TempFolder folder;
  nlohmann::ordered_json value;
  value["version"] = "1";
  value["job"] = 2;
  writeJson(folder / "a.json", value);
  EXPECT_EQ(bytesOf(folder / "a.json"), "{\n  \"version\": \"1\",\n  \"job\": 2\n}\n");
}

TEST(Json, WritesFileNamesThatAreNotUtf8) {
  const TempFolder folder;
  writeJson(folder / "a.json", nlohmann::json{{"scene", "b\xff.gltf"}});
  EXPECT_EQ(readJson(folder / "a.json")["scene"], "b\xEF\xBF\xBD.gltf");  // U+FFFD
}

TEST(Json, AnErrorNamesLineAndColumn) {
  const TempFolder folder;
  writeBytes(folder / "a.json", "{\n  \"a\": 1,\n  b\n}");
  const std::string message = messageOf<InputError>([&] { (void)readJson(folder / "a.json"); });
  EXPECT_THAT(message, HasSubstr("a.json: parse error at line 3, column 3"));
  writeBytes(folder / "empty.json", "");
  EXPECT_THROW((void)readJson(folder / "empty.json"), InputError);
}

TEST(Json, DeepNestingIsRefusedAndDoesNotExhaustTheStack) {
  const TempFolder folder;
  writeBytes(folder / "deep.json", std::string(1000000, '['));
  EXPECT_THAT(messageOf<InputError>([&] { (void)readJson(folder / "deep.json"); }),
              HasSubstr("128 nested levels"));
  writeBytes(folder / "fine.json", std::string(100, '[') + std::string(100, ']'));
  EXPECT_NO_THROW((void)readJson(folder / "fine.json"));
}

}  // namespace
}  // namespace promenade::io
