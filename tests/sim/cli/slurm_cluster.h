#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "tests/sim/cli/program.h"

namespace assay::cli {

// A Slurm cluster whose only node is this machine. It consists of munged, slurmctld and slurmd,
// with all their files in a temporary folder. The destructor ends it.
class SlurmCluster {
 public:
  SlurmCluster();
  ~SlurmCluster();
  SlurmCluster(const SlurmCluster&) = delete;
  SlurmCluster& operator=(const SlurmCluster&) = delete;

  // Returns why the cluster takes no jobs. Empty means that it takes them.
  const std::string& trouble() const { return trouble_; }
  // Runs a shell script in the folder as a user of the cluster. Returns its standard output.
  std::string Shell(const std::string& script, const std::string& folder) const;

 private:
  std::string In(const std::string& name) const { return folder_ / name; }
  bool Installed() const;
  void WriteConfiguration() const;
  void Start(const std::vector<std::string>& command);
  bool Idle() const;  // returns whether the node waits for jobs

  Folder folder_;
  std::vector<pid_t> daemons_;
  std::string trouble_;
};

}  // namespace assay::cli
