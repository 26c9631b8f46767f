// The arrows between folders (docs/architecture.md) and the libraries that stay inside one folder.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file;
  std::string target;
};

const std::vector<std::string> kFolders = {"src/core", "src/scene", "src/render", "src/io", "src/walkthrough",
                                           "src/app",  "aqm",       "ibr",        "paths"};

/// What each folder may include besides itself.
const std::map<std::string, std::set<std::string>> kAllowed = {
    {"src/core", {}},
    {"aqm", {"src/core"}},
    {"ibr", {"src/core"}},
    {"paths", {"src/core"}},
    {"src/scene", {"src/core"}},
    {"src/render", {"src/core", "src/scene"}},
    {"src/io", {"src/core", "paths"}},
    {"src/walkthrough", {"src/core", "paths", "aqm", "ibr", "src/render", "src/io"}},
    {"src/app", {"src/core", "src/scene", "src/render", "src/io", "src/walkthrough", "aqm", "ibr", "paths"}},
};

std::string withoutLeadingBlanks(const std::string& text) {
  return text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
}

std::vector<Include> includesOf(const std::string& text, const std::string& file) {
  std::vector<Include> includes;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line = withoutLeadingBlanks(line);
    if (line.rfind("#", 0) != 0) continue;
    line = withoutLeadingBlanks(line.substr(1));
    if (line.rfind("include", 0) != 0) continue;
    const std::size_t begin = line.find_first_of("<\"");
    const std::size_t end = begin == std::string::npos ? begin : line.find_first_of(">\"", begin + 1);
    if (end != std::string::npos) includes.push_back({file, line.substr(begin + 1, end - begin - 1)});
  }
  return includes;
}

std::vector<Include> includesBelow(const std::string& folder) {
  std::vector<Include> includes;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(PROMENADE_SOURCE_DIR) / folder)) {
    const auto extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream in(entry.path());
    const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    for (Include& include : includesOf(text, fs::relative(entry.path(), PROMENADE_SOURCE_DIR).string())) {
      includes.push_back(std::move(include));
    }
  }
  return includes;
}

std::string folderOf(const std::string& target) {
  for (const std::string& folder : kFolders) {
    if (target.rfind(folder + "/", 0) == 0) return folder;
  }
  return {};
}

/// The includes of `folder` that go against the arrows.
std::vector<std::string> wrongArrows(const std::string& folder, const std::vector<Include>& includes) {
  std::vector<std::string> wrong;
  for (const Include& include : includes) {
    const std::string target = folderOf(include.target);
    const bool isOwn = target.empty() || target == folder;
    if (!isOwn && !kAllowed.at(folder).contains(target))
      wrong.push_back(include.file + " includes " + include.target);
  }
  return wrong;
}

bool startsWithAny(const std::string& text, const std::vector<std::string>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(), [&](const auto& p) { return text.rfind(p, 0) == 0; });
}

}  // namespace

TEST(Includes, FollowTheArrowsBetweenFolders) {
  for (const std::string& folder : kFolders) {
    EXPECT_THAT(wrongArrows(folder, includesBelow(folder)), testing::IsEmpty());
  }
}

TEST(Includes, AreFoundInEveryFolder) {
  for (const std::string& folder : kFolders) EXPECT_FALSE(includesBelow(folder).empty()) << folder;
}

TEST(Includes, AgainstAnArrowAreReported) {
  const auto includes = includesOf(
      "#include \"src/core/image.h\"\n # include \"ibr/warp.h\" // why\n#include <vector>\n", "aqm/x.h");
  EXPECT_THAT(wrongArrows("aqm", includes), testing::ElementsAre("aqm/x.h includes ibr/warp.h"));
}

TEST(Includes, KeepEmbreeInsideTheRendererAndTinygltfInsideTheLoader) {
  for (const std::string& folder : kFolders) {
    for (const Include& include : includesBelow(folder)) {
      if (folder != "src/render") {
        EXPECT_FALSE(startsWithAny(include.target, {"embree3/"})) << include.file;
      }
      if (folder != "src/scene") {
        EXPECT_FALSE(startsWithAny(include.target, {"tiny_gltf", "tinygltf"})) << include.file;
      }
    }
  }
}

TEST(Includes, KeepImageAndVideoLibrariesOutOfPublicHeaders) {
  for (const std::string& folder : kFolders) {
    for (const Include& include : includesBelow(folder)) {
      const bool isHeader = include.file.ends_with(".h");
      if (!isHeader || include.file.ends_with("_internal.h")) continue;
      EXPECT_FALSE(startsWithAny(
          include.target, {"OpenColorIO/", "OpenImageIO/", "OpenEXR/", "Imf", "libav", "libsw", "fftw3"}))
          << include.file << " includes " << include.target;
    }
  }
}

TEST(Includes, KeepFilesAndTheTerminalOutOfTheOtherFolders) {
  for (const std::string folder : {"src/core", "src/render", "src/walkthrough", "aqm", "ibr", "paths"}) {
    for (const Include& include : includesBelow(folder)) {
      EXPECT_FALSE(startsWithAny(include.target, {"fstream", "iostream", "cstdio", "stdio.h", "filesystem"}))
          << include.file << " includes " << include.target;
    }
  }
}
