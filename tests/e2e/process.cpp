#include "tests/e2e/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace promenade::e2e {
namespace {

std::filesystem::path temporary(const char* kind) {
  static std::atomic<int> count{0};
  return std::filesystem::temp_directory_path() /
         ("promenade-e2e-" + std::to_string(getpid()) + "-" + std::to_string(count++) + kind);
}

}  // namespace

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string Outcome::error() const {
  std::istringstream lines(err);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("promenade: error:", 0) == 0) return line;
  }
  return {};
}

Process::Process(const std::vector<std::string>& arguments, const std::function<void()>& prepare)
    : out_(temporary(".out")), err_(temporary(".err")) {
  std::vector<std::string> all = {PROMENADE_BINARY};
  all.insert(all.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& argument : all) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ == 0) {
    const int out = open(out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int err = open(err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int in = open("/dev/null", O_RDONLY);
    if (out < 0 || err < 0 || in < 0) _exit(127);
    dup2(in, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    if (prepare) prepare();
    execv(argv[0], argv.data());
    _exit(127);
  }
}

Process::~Process() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  std::error_code ignored;
  std::filesystem::remove(out_, ignored);
  std::filesystem::remove(err_, ignored);
}

void Process::send(int signal) const {
  kill(pid_, signal);
}

Outcome Process::wait(std::chrono::seconds limit) {
  Outcome outcome;
  const auto end = std::chrono::steady_clock::now() + limit;
  int state = 0;
  while (waitpid(pid_, &state, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) {
      outcome.timedOut = true;
      kill(pid_, SIGKILL);
      waitpid(pid_, &state, 0);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  pid_ = -1;
  if (WIFEXITED(state)) outcome.status = WEXITSTATUS(state);
  if (WIFSIGNALED(state)) outcome.signal = WTERMSIG(state);
  outcome.out = contents(out_);
  outcome.err = contents(err_);
  return outcome;
}

Outcome run(const std::vector<std::string>& arguments, const std::function<void()>& prepare) {
  return Process(arguments, prepare).wait();
}

}  // namespace promenade::e2e
