#include "tests/sim/cli/slurm_cluster.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <thread>

namespace assay::cli {
namespace {

namespace fs = std::filesystem;

// The daemons are in folders that only root's PATH contains.
constexpr const char* kPath = "PATH=$PATH:/usr/sbin:/sbin; export PATH; ";

std::string Output(const std::string& command) {
  std::string output;
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  pclose(pipe);
  return output;
}

// Returns a port on which no program listens.
int FreePort() {
  const int handle = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  bind(handle, reinterpret_cast<sockaddr*>(&address), size);
  getsockname(handle, reinterpret_cast<sockaddr*>(&address), &size);
  close(handle);
  return ntohs(address.sin_port);
}

}  // namespace

SlurmCluster::SlurmCluster() {
  if (!Installed()) {
    trouble_ = "Slurm is not installed (apt-get install slurmctld slurmd slurm-client munge)";
    return;
  }
  if (geteuid() != 0) {
    trouble_ = "Slurm's daemons want to be started by root";
    return;
  }
  WriteConfiguration();
  Start({"munged", "--foreground", "--force", "--socket=" + In("socket"), "--key-file=" + In("key"),
         "--pid-file=" + In("munged.pid"), "--log-file=" + In("munged.log"),
         "--seed-file=" + In("seed")});
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  Start({"slurmctld", "-D", "-f", In("slurm.conf")});
  Start({"slurmd", "-D", "-f", In("slurm.conf")});
  for (int i = 0; i < 100; ++i) {
    if (Idle()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  trouble_ = "Slurm's daemons do not start here";
}

SlurmCluster::~SlurmCluster() {
  // The daemons are ended in the opposite order of their start. Each is waited for, so that none
  // writes into the folder after it is removed.
  for (auto daemon = daemons_.rbegin(); daemon != daemons_.rend(); ++daemon) {
    kill(*daemon, SIGTERM);
    for (int i = 0; i < 50 && waitpid(*daemon, nullptr, WNOHANG) == 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    kill(*daemon, SIGKILL);
    waitpid(*daemon, nullptr, 0);
  }
}

bool SlurmCluster::Installed() const {
  for (const char* program : {"munged", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo"}) {
    if (Output(kPath + std::string("command -v ") + program).empty()) return false;
  }
  return true;
}

void SlurmCluster::WriteConfiguration() const {
  const std::string key =
      folder_.Write("key", std::string(64, 'k') + TextOf("/proc/sys/kernel/random/uuid"));
  chmod(key.c_str(), 0400);
  for (const char* name : {"state", "spool"}) fs::create_directories(In(name));
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  const std::string node = std::string(host).substr(0, std::string(host).find('.'));
  folder_.Write("cgroup.conf", "CgroupPlugin=cgroup/v1\n");
  folder_.Write(
      "slurm.conf",
      "ClusterName=assay\nSlurmctldHost=" + node + "(127.0.0.1)\n" +
          "SlurmUser=root\nSlurmdUser=root\nAuthType=auth/munge\nAuthInfo=socket=" + In("socket") +
          "\nCredType=cred/munge\nSlurmctldPort=" + std::to_string(FreePort()) +
          "\nSlurmdPort=" + std::to_string(FreePort()) + "\nStateSaveLocation=" + In("state") +
          "\nSlurmdSpoolDir=" + In("spool") + "\nSlurmctldPidFile=" + In("slurmctld.pid") +
          "\nSlurmdPidFile=" + In("slurmd.pid") + "\nSlurmctldLogFile=" + In("slurmctld.log") +
          "\nSlurmdLogFile=" + In("slurmd.log") +
          "\nProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\nSwitchType=switch/none\n"
          "MpiDefault=none\nJobAcctGatherType=jobacct_gather/none\n"
          "AccountingStorageType=accounting_storage/none\nSchedulerType=sched/backfill\n"
          "SchedulerParameters=sched_interval=1,bf_interval=1\nSelectType=select/cons_tres\n"
          "SelectTypeParameters=CR_CPU\nReturnToService=2\n"
          "NodeName=" +
          node + " NodeAddr=127.0.0.1 CPUs=" +
          std::to_string(std::max(1U, std::thread::hardware_concurrency())) +
          " State=UNKNOWN\n"
          "PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP\n");
}

void SlurmCluster::Start(const std::vector<std::string>& command) {
  const std::string log = In(command[0] + ".out");
  const pid_t child = fork();
  if (child != 0) {
    daemons_.push_back(child);
    return;
  }
  const int out = open(log.c_str(), O_WRONLY | O_CREAT, 0600);
  dup2(out, STDOUT_FILENO);
  dup2(out, STDERR_FILENO);
  setenv("PATH", (std::string(getenv("PATH")) + ":/usr/sbin:/sbin").c_str(), 1);
  setenv("SLURM_CONF", (In("slurm.conf")).c_str(), 1);
  std::vector<char*> arguments;
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  _exit(127);
}

bool SlurmCluster::Idle() const {
  return Shell("timeout 5 sinfo --noheader --format %T", ".").starts_with("idle");
}

std::string SlurmCluster::Shell(const std::string& script, const std::string& folder) const {
  return Output("SLURM_CONF='" + In("slurm.conf") + "'; export SLURM_CONF; cd '" + folder +
                "'; { " + script + "\n} 2>&1");
}

}  // namespace assay::cli
