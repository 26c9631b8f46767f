#include "src/io/sequence.h"

#include <glob.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <map>
#include <set>
#include <string_view>
#include <system_error>

#include "src/core/errors.h"
#include "src/io/file_error.h"
#include "src/io/image_extensions.h"

namespace promenade::io {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 7> kVideoExtensions{".mp4",  ".mov", ".m4v", ".mkv",
                                                           ".webm", ".avi", ".gif"};

std::string extensionOf(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

bool isVideoName(const fs::path& file) {
  return std::ranges::find(kVideoExtensions, extensionOf(file)) != kVideoExtensions.end();
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// The regular files of a folder that are not hidden, in the order of their names.
std::vector<fs::path> filesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (entry->path().filename().string().starts_with('.') || !entry->is_regular_file(ignored)) continue;
    files.push_back(entry->path());
  }
  if (error) throwFileError(error.value(), folder, "list the folder");
  std::ranges::sort(files, {}, [](const fs::path& file) { return file.filename().string(); });
  return files;
}

std::vector<fs::path> imagesIn(const fs::path& folder) {
  std::vector<fs::path> files = filesIn(folder);
  const std::set<std::string> extensions = imageExtensions();
  std::erase_if(files, [&](const fs::path& file) { return !extensions.contains(extensionOf(file)); });
  return files;
}

// "12 images (000000.exr to 000011.exr)"
std::string described(const std::vector<fs::path>& images) {
  if (images.empty()) return "no image";
  if (images.size() == 1) return "1 image (" + images.front().filename().string() + ")";
  return std::to_string(images.size()) + " images (" + images.front().filename().string() + " to " +
         images.back().filename().string() + ")";
}

// What is where a name leads, for messages about names that lead nowhere.
std::string surroundings(const fs::path& file) {
  const fs::path folder = folderOf(file);
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return "there is no folder " + folder.string();
  return folder.string() + " holds " + described(imagesIn(folder));
}

std::vector<fs::path> fromFolder(const fs::path& folder) {
  std::vector<fs::path> images = imagesIn(folder);
  std::error_code ignored;
  if (images.empty() && fs::is_directory(folder / "frames", ignored)) return fromFolder(folder / "frames");
  if (images.empty()) {
    throw InputError(folder.string(), "expected a folder of images, found no image among its " +
                                          std::to_string(filesIn(folder).size()) + " files");
  }
  std::map<std::string, int> counts;
  for (const fs::path& image : images) ++counts[extensionOf(image)];
  if (counts.size() > 1) {
    std::string kinds;
    for (const auto& [extension, count] : counts) {
      kinds += (kinds.empty() ? "" : ", ") + std::to_string(count) + " " + extension;
    }
    throw InputError(folder.string(), "expected images of one kind, found " + kinds +
                                          "; name them by a pattern like " +
                                          (folder / ("*" + extensionOf(images.front()))).string());
  }
  return images;
}

// A file name with one number in it.
struct NumberPattern {
  std::string before;
  std::size_t digits = 1;  // at least so many, zero-padded
  std::string after;
};

std::optional<NumberPattern> numberPattern(const std::string& name) {
  const auto percent = name.find('%');
  if (percent == std::string::npos) return std::nullopt;
  auto at = percent + 1;
  NumberPattern pattern;
  if (at < name.size() && name[at] == '0') ++at;
  const auto digitsEnd = std::min(name.find_first_not_of("0123456789", at), name.size());
  if (digitsEnd > at) std::from_chars(name.data() + at, name.data() + digitsEnd, pattern.digits);
  if (digitsEnd >= name.size() || name[digitsEnd] != 'd') return std::nullopt;
  pattern.before = name.substr(0, percent);
  pattern.after = name.substr(digitsEnd + 1);
  if (pattern.after.find('%') != std::string::npos) return std::nullopt;
  return pattern;
}

std::optional<long> numberOf(const std::string& name, const NumberPattern& pattern) {
  if (name.size() <= pattern.before.size() + pattern.after.size()) return std::nullopt;
  if (!name.starts_with(pattern.before) || !name.ends_with(pattern.after)) return std::nullopt;
  const std::string digits =
      name.substr(pattern.before.size(), name.size() - pattern.before.size() - pattern.after.size());
  if (digits.size() < pattern.digits || (digits.size() > pattern.digits && digits.front() == '0'))
    return std::nullopt;
  long number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || end != digits.data() + digits.size() || digits.front() == '-')
    return std::nullopt;
  return number;
}

std::vector<fs::path> fromPattern(const fs::path& argument, const NumberPattern& pattern) {
  std::error_code ignored;
  std::map<long, fs::path> numbered;
  if (fs::is_directory(folderOf(argument), ignored)) {
    for (const fs::path& file : filesIn(folderOf(argument))) {
      if (const auto number = numberOf(file.filename().string(), pattern)) numbered[*number] = file;
    }
  }
  if (numbered.empty())
    throw InputError(argument.string(), "no file has such a name; " + surroundings(argument));
  std::vector<fs::path> images;
  long expected = numbered.begin()->first;
  for (const auto& [number, file] : numbered) {
    if (number != expected) {
      throw InputError(argument.string(), "frame " + std::to_string(expected) + " is missing; found " +
                                              std::to_string(numbered.size()) + " frames from " +
                                              std::to_string(numbered.begin()->first) + " to " +
                                              std::to_string(numbered.rbegin()->first));
    }
    images.push_back(file);
    ++expected;
  }
  return images;
}

std::vector<fs::path> fromGlob(const std::string& argument) {
  struct Matches {
    glob_t found{};
    Matches() = default;
    Matches(const Matches&) = delete;
    Matches& operator=(const Matches&) = delete;
    ~Matches() { ::globfree(&found); }
  } matches;
  const int status = ::glob(argument.c_str(), GLOB_NOSORT, nullptr, &matches.found);
  if (status == GLOB_NOSPACE) throw CannotContinue(argument + ": out of memory while matching names");
  std::vector<fs::path> images;
  if (status == 0) {
    for (std::size_t i = 0; i < matches.found.gl_pathc; ++i) {
      const fs::path file = matches.found.gl_pathv[i];
      std::error_code ignored;
      if (fs::is_regular_file(file, ignored)) images.push_back(file);
    }
  }
  if (images.empty()) throw InputError(argument, "no file has such a name; " + surroundings(argument));
  std::ranges::sort(images, {}, [](const fs::path& file) { return file.string(); });
  return images;
}

}  // namespace

Sequence resolveSequence(const std::string& argument) {
  const fs::path path = argument;
  Sequence sequence;
  sequence.argument = argument;
  std::error_code error;
  const auto type = fs::status(path, error).type();
  if (type == fs::file_type::directory) {
    sequence.images = fromFolder(path);
  } else if (type != fs::file_type::not_found && type != fs::file_type::none) {
    requireRegularFile(path);
    if (isVideoName(path)) {
      sequence.video = path;
    } else {
      sequence.images = {path};
    }
  } else if (const auto pattern = numberPattern(path.filename().string())) {
    sequence.images = fromPattern(path, *pattern);
  } else if (argument.find_first_of("*?[") != std::string::npos) {
    sequence.images = fromGlob(argument);
  } else {
    throw InputError(argument, "no such file or folder; " + surroundings(path));
  }
  return sequence;
}

}  // namespace promenade::io
