#pragma once

#include <filesystem>
#include <string>

#include "planner/domain/workcell/model_path.h"

namespace assay::sweep {

// The distribution of a sweep over a cluster.
struct SlurmJob {
  std::filesystem::path program;   // assay
  std::filesystem::path sweep;     // the sweep file
  std::filesystem::path database;  // the database of the whole sweep
  domain::ModelPath models;        // the folders as the user gave them
  int tasks = 1;                   // number of shards
  int jobs = 1;                    // threads of each task
};

// Returns a script for sbatch with a Slurm job array that has one task for each shard. Comments in
// the script explain how to submit it, and how to submit the job that merges the tasks' databases.
std::string SlurmScript(const SlurmJob& job);

// Returns the path of a shard's database, like "out/peg-2.sqlite". The index may be a shell
// expression.
std::string ShardDatabase(const std::filesystem::path& database, const std::string& index);

}  // namespace assay::sweep
