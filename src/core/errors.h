#pragma once
// The errors that leave the program with one clear line. Bugs hit assertions instead.

#include <stdexcept>
#include <string>

namespace promenade {

/// Bad input or usage: exit status 2. The message is one line that says which file, where in it, what was
/// expected and what was found, e.g. "scene.gltf: accessors[3].count: expected at least 1, found 0".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// `where` is a file, or a file and a place in it.
  InputError(const std::string& where, const std::string& what) : std::runtime_error(where + ": " + what) {}
};

/// The input is good but the work cannot go on (disk full, out of memory): exit status 3.
class CannotContinue : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The user asked to stop (Ctrl-C): exit status 130. Thrown from progress callbacks and cancellation points.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace promenade
