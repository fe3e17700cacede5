// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <drawpoint/tests/support/files.hpp>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>

/// A Slurm cluster for tests: controller, nodes and authentication as processes of this user on the loopback
/// device, with all files in one folder. It ends with the object. Needs slurmctld, slurmd, slurm-client and
/// munge.
namespace drawpoint::support {

/// A port of the loopback device that nobody has now.
inline int free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const bool bound = bind(socket, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                     getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  close(socket);
  if (!bound) throw std::runtime_error("no free port on the loopback device");
  return ntohs(address.sin_port);
}

class SlurmCluster {
 public:
  /// Nodes n1, n2, ..., each of which counts as so many cores, whatever the machine has. SLURM_CONF of this process
  /// then names the cluster.
  SlurmCluster(const std::filesystem::path& folder, int nodes, int cores = 2)
      : folder_(folder), nodes_(nodes), cores_(cores) {
    for (const char* part : {"state", "spool", "log"}) std::filesystem::create_directories(folder_ / part);
    write_configuration();
    setenv("SLURM_CONF", (folder_ / "slurm.conf").c_str(), 1);
    shell("head -c 128 /dev/urandom >munge.key && chmod 400 munge.key && chmod 700 .");
    shell(
        "munged --force --key-file=$PWD/munge.key --socket=$PWD/munge.socket --pid-file=$PWD/munge.pid "
        "--log-file=$PWD/log/munged.log --seed-file=$PWD/munge.seed");
    shell("slurmctld");
    for (int node = 1; node <= nodes_; ++node) shell("slurmd -N n" + std::to_string(node));
    await([&] { return idle_nodes() == nodes_; });
  }
  ~SlurmCluster() {
    for (int node = 1; node <= nodes_; ++node) kill_all_of(node);
    kill_by_file("slurmctld.pid", SIGKILL);
    kill_by_file("munge.pid", SIGKILL);
    unsetenv("SLURM_CONF");
  }
  SlurmCluster(const SlurmCluster&) = delete;
  SlurmCluster& operator=(const SlurmCluster&) = delete;

  /// As when its power fails and the cluster's watch says so: the daemon and all that runs on the node are
  /// killed, the node is down. (Slurm itself, with the time-outs of a loaded test machine, takes minutes to
  /// see it.)
  void lose(int node) const {
    kill_all_of(node);
    shell("scontrol update NodeName=n" + std::to_string(node) + " State=DOWN Reason=lost");
  }

  int idle_nodes() const {
    shell("sinfo --noheader --Node --states=idle >idle.txt 2>&1 || true");
    const std::string text = contents(folder_ / "idle.txt");
    int lines = 0;
    for (const char c : text) lines += c == '\n';
    return text.find("error") == text.npos ? lines : 0;
  }

  /// Tasks that Slurm has waiting or running.
  int tasks() const {
    shell("squeue --noheader --array >tasks.txt");
    int lines = 0;
    for (const char c : contents(folder_ / "tasks.txt")) lines += c == '\n';
    return lines;
  }

  template <class Condition>
  void await(const Condition& condition) const {
    for (int i = 0; i < 600; ++i) {
      if (condition()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    throw std::runtime_error("the Slurm cluster of the test was not so far within a minute:\n" +
                             contents(folder_ / "log" / "slurmctld.log"));
  }

 private:
  void shell(const std::string& line) const {
    if (std::system(("cd '" + folder_.string() + "' && " + line).c_str()) != 0)
      throw std::runtime_error("the test's Slurm cluster: \"" + line +
                               "\" failed; it needs the packages slurmctld, slurmd, slurm-client and munge");
  }

  void kill_all_of(int node) const {
    kill_by_file("slurmd.n" + std::to_string(node) + ".pid", SIGKILL);
    const std::string mark = "SLURMD_NODENAME=n" + std::to_string(node);
    for (const auto& process : std::filesystem::directory_iterator("/proc")) {
      std::string environment = contents(process.path() / "environ");
      environment.push_back('\0');
      const bool here = environment.find(mark + '\0') != environment.npos &&
                        environment.find(folder_.string()) != environment.npos;
      if (here) kill(std::stoi(process.path().filename()), SIGKILL);
    }
  }

  void kill_by_file(const std::string& file, int signal) const {
    const pid_t process = std::atoi(contents(folder_ / file).c_str());
    if (process > 0) kill(process, signal);
    std::filesystem::remove(folder_ / file);
  }

  void write_configuration() const {
    char host[256] = {};
    gethostname(host, sizeof host - 1);
    const std::string name = std::string(host).substr(0, std::string(host).find('.'));
    const std::string user = geteuid() == 0 ? "root" : std::getenv("USER");
    const std::string at = folder_.string();
    std::ofstream file(folder_ / "slurm.conf");
    file << "ClusterName=drawpoint_test\nSlurmctldHost=" << name << "(127.0.0.1)\nSlurmUser=" << user
         << "\nSlurmdUser=" << user << "\nAuthType=auth/munge\nCredType=cred/munge\nAuthInfo=socket=" << at
         << "/munge.socket\nSlurmctldPort=" << free_port() << "\nStateSaveLocation=" << at
         << "/state\nSlurmctldPidFile=" << at << "/slurmctld.pid\nSlurmdPidFile=" << at
         << "/slurmd.%n.pid\nSlurmdSpoolDir=" << at << "/spool/%n\nSlurmctldLogFile=" << at
         << "/log/slurmctld.log\nSlurmdLogFile=" << at
         << "/log/slurmd.%n.log\nProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\n"
            "JobAcctGatherType=jobacct_gather/none\nSelectType=select/"
            "cons_tres\nSelectTypeParameters=CR_Core\n"
            "SchedulerType=sched/backfill\nSchedulerParameters=sched_min_interval=0,bf_interval=1\n"
            "KillWait=1\nReturnToService=2\nSlurmdParameters=config_overrides\n";
    for (int node = 1; node <= nodes_; ++node)
      file << "NodeName=n" << node << " NodeHostname=" << name << " NodeAddr=127.0.0.1 Port=" << free_port()
           << " CPUs=" << cores_ << " State=UNKNOWN\n";
    file << "PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP\n";
  }

  std::filesystem::path folder_;
  int nodes_, cores_;
};

}  // namespace drawpoint::support
