#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "tests/sim/cli/program.h"

namespace assay::cli {

// A Slurm of one node, this one, of its own: munged, slurmctld and slurmd with all their files in a
// temporary folder, ended with the object.
class SlurmCluster {
 public:
  SlurmCluster();
  ~SlurmCluster();
  SlurmCluster(const SlurmCluster&) = delete;
  SlurmCluster& operator=(const SlurmCluster&) = delete;

  // Empty: it takes jobs; else why it does not.
  const std::string& trouble() const { return trouble_; }
  // Runs a shell script as a user of the cluster, in the folder; its standard output.
  std::string Shell(const std::string& script, const std::string& folder) const;

 private:
  std::string In(const std::string& name) const { return folder_ / name; }
  bool Installed() const;
  void WriteConfiguration() const;
  void Start(const std::vector<std::string>& command);
  bool Idle() const;  // the node waits for jobs

  Folder folder_;
  std::vector<pid_t> daemons_;
  std::string trouble_;
};

}  // namespace assay::cli
