#pragma once

#include <filesystem>
#include <string>

#include "planner/domain/workcell/model_path.h"

namespace assay::sweep {

// How a sweep is spread over a cluster.
struct SlurmJob {
  std::filesystem::path program;   // assay
  std::filesystem::path sweep;     // the sweep file
  std::filesystem::path database;  // of the whole sweep
  domain::ModelPath models;        // as the user gave them
  int tasks = 1;                   // shards
  int jobs = 1;                    // threads of each
};

// A Slurm job array, one task for each shard, as a script for sbatch. Its comments tell how it is
// submitted, with the job that merges what the tasks have written.
std::string SlurmScript(const SlurmJob& job);

// "out/peg-2.sqlite", of the shard with this index; the index may be a shell expression.
std::string ShardDatabase(const std::filesystem::path& database, const std::string& index);

}  // namespace assay::sweep
