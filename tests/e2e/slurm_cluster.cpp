#include "tests/e2e/slurm_cluster.h"

#include <fcntl.h>
#include <netinet/in.h>
#include <pwd.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>

namespace promenade::e2e {
namespace {

namespace fs = std::filesystem;

int freePort() {
  const int handle = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof(address);
  auto* general = reinterpret_cast<sockaddr*>(&address);
  const bool bound = ::bind(handle, general, length) == 0 && ::getsockname(handle, general, &length) == 0;
  ::close(handle);
  return bound ? ntohs(address.sin_port) : 0;
}

std::string hostName() {
  std::array<char, 256> name{};
  ::gethostname(name.data(), name.size() - 1);
  return name.data();
}

void writeKey(const fs::path& file) {
  std::ofstream out(file, std::ios::binary);
  std::random_device random;
  for (int i = 0; i < 256; ++i) {
    const unsigned word = random();
    out.write(reinterpret_cast<const char*>(&word), sizeof(word));
  }
  out.close();
  fs::permissions(file, fs::perms::owner_read);
}

void writeConfiguration(const fs::path& folder) {
  const passwd* user = ::getpwuid(::getuid());
  const std::string name = user != nullptr ? user->pw_name : "root";
  const std::string at = folder.string();
  std::ofstream out(folder / "slurm.conf");
  out << "ClusterName=promenade\nSlurmctldHost=" << hostName() << "(127.0.0.1)\n"
      << "SlurmUser=" << name << "\nSlurmdUser=" << name
      << "\n"
      // A requeued task may start again when its credential has expired.
      << "AuthType=auth/munge\nAuthInfo=socket=" << at << "/munge.socket,cred_expire=5\nCredType=cred/munge\n"
      << "SlurmctldPort=" << freePort() << "\n"
      << "SlurmctldPidFile=" << at << "/slurmctld.pid\nSlurmdPidFile=" << at << "/slurmd-%n.pid\n"
      << "SlurmdSpoolDir=" << at << "/spool-%n\nStateSaveLocation=" << at << "/state\n"
      << "SlurmctldLogFile=" << at << "/slurmctld.log\nSlurmdLogFile=" << at << "/slurmd-%n.log\n"
      << "ProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\nSwitchType=switch/none\nMpiDefault=none\n"
      << "SchedulerType=sched/backfill\nSchedulerParameters=bf_interval=1,sched_interval=2\n"
      << "SelectType=select/cons_tres\nSelectTypeParameters=CR_Core\n"
      << "JobAcctGatherType=jobacct_gather/none\nAccountingStorageType=accounting_storage/none\n"
      << "ReturnToService=2\n";
  for (const char* node : {"node1", "node2"}) {
    out << "NodeName=" << node << " NodeHostname=" << hostName() << " NodeAddr=127.0.0.1 Port=" << freePort()
        << " CPUs=1 State=UNKNOWN\n";
  }
  out << "PartitionName=all Nodes=node1,node2 Default=YES MaxTime=INFINITE State=UP\n";
}

}  // namespace

std::string outputOf(const std::string& command) {
  FILE* pipe = ::popen((command + " 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) return {};
  std::string text;
  std::array<char, 512> block;
  while (std::fgets(block.data(), block.size(), pipe) != nullptr) text += block.data();
  return ::pclose(pipe) == 0 ? text : std::string();
}

// A program that runs in the foreground until it is told to end, or this process ends, in whatever way.
class SlurmCluster::Daemon {
 public:
  Daemon(std::vector<std::string> arguments, const fs::path& log) {
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const pid_t parent = ::getpid();
    pid_ = ::fork();
    if (pid_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(127);
    const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(out, STDERR_FILENO);
    ::execvp(argv.front(), argv.data());
    ::_exit(127);
  }
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;
  ~Daemon() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGTERM);
    for (int i = 0; i < 50; ++i) {
      if (::waitpid(pid_, nullptr, WNOHANG) != 0) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }

 private:
  pid_t pid_ = -1;
};

SlurmCluster::SlurmCluster() {
  for (const char* program : {"munged", "slurmctld", "slurmd", "sbatch"}) {
    if (outputOf(std::string("PATH=$PATH:/usr/sbin command -v ") + program).empty()) {
      reason_ = std::string(program) + " is not installed (Debian: apt-get install slurm-wlm munge)";
      return;
    }
  }
  // Not below the folder of the test: the name of a socket has at most 107 characters (unix(7)).
  std::string name = "/tmp/promenade-slurm-XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) {
    reason_ = "no folder can be made in /tmp";
    return;
  }
  folder_ = name;
  start();
}

void SlurmCluster::start() {
  const fs::path& folder = folder_;
  fs::create_directories(folder / "state");
  fs::permissions(folder, fs::perms(0755));
  writeKey(folder / "munge.key");
  writeConfiguration(folder);
  ::setenv("PATH", (std::string(::getenv("PATH")) + ":/usr/sbin").c_str(), 1);
  ::setenv("SLURM_CONF", (folder / "slurm.conf").c_str(), 1);
  const auto run = [&](std::vector<std::string> arguments) {
    daemons_.push_back(std::make_unique<Daemon>(std::move(arguments), folder / "daemons.log"));
  };
  const std::string at = folder.string();
  run({"munged", "--foreground", "--force", "--socket=" + at + "/munge.socket",
       "--key-file=" + at + "/munge.key", "--pid-file=" + at + "/munged.pid",
       "--seed-file=" + at + "/munge.seed", "--log-file=" + at + "/munged.log"});
  for (int i = 0; i < 100 && !fs::exists(folder / "munge.socket"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  run({"slurmctld", "-D"});
  run({"slurmd", "-D", "-N", "node1"});
  run({"slurmd", "-D", "-N", "node2"});
  for (int i = 0; i < 60; ++i) {
    if (outputOf("sinfo --noheader --states=idle --format=%D") == "2\n") return;
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
  std::ifstream log(folder / "daemons.log");
  reason_ = "two nodes do not come up here: " +
            std::string(std::istreambuf_iterator<char>(log), std::istreambuf_iterator<char>());
}

SlurmCluster::~SlurmCluster() {
  if (folder_.empty()) return;
  if (reason_.empty()) {
    (void)outputOf("scancel --me");
    for (int i = 0; i < 50 && !outputOf("squeue --noheader --me").empty(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  while (!daemons_.empty()) daemons_.pop_back();
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace promenade::e2e
