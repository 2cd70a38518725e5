#include "sim/sweep/shell_commands/slurm.h"

#include <fmt/format.h>

#include "sim/sweep/shell_commands/shell.h"

namespace assay::sweep {
namespace {

namespace fs = std::filesystem;

// Paths in the script are absolute, because Slurm runs a job in the folder from which it was
// submitted.
std::string Absolute(const fs::path& path) {
  return Quoted(fs::absolute(path).lexically_normal().string());
}

// Returns the paths of all shards' databases as words for the shell.
std::string AllShards(const SlurmJob& job) {
  std::string names;
  for (int i = 1; i <= job.tasks; ++i) {
    names += ' ' + Quoted(ShardDatabase(fs::absolute(job.database), std::to_string(i)));
  }
  return names;
}

}  // namespace

std::string ShardDatabase(const fs::path& database, const std::string& index) {
  fs::path shard = database;
  shard.replace_filename(
      fmt::format("{}-{}{}", database.stem().string(), index, database.extension().string()));
  return shard.lexically_normal().string();
}

std::string SlurmScript(const SlurmJob& job) {
  const std::string program = Absolute(job.program);
  const std::string database = Absolute(job.database);
  const std::string merge = fmt::format("{} sweep merge {}{}", program, database, AllShards(job));
  std::string models;
  for (const std::filesystem::path& folder : job.models.folders()) {
    models += fmt::format(" --models {}", Absolute(folder));
  }
  return fmt::format(
      R"(#!/bin/sh
#SBATCH --job-name=assay-sweep
#SBATCH --array=1-{tasks}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={jobs}
#SBATCH --requeue
#SBATCH --open-mode=append
#
# Submit this script, then the job that merges what its tasks write:
#   job=$(sbatch --parsable THIS-SCRIPT)
#   sbatch --dependency=afterok:$job --wrap {merge}
#
# A task that was killed goes on where it was, if it is submitted again.
shard=$SLURM_ARRAY_TASK_ID
database={stem}-$shard{extension}
{program} sweep {sweep} --db "$database" --resume \
  --shard "$shard/{tasks}" --jobs {jobs}{models}
code=$?
# That trials failed or predictions were violated is a result, not a failure of the job.
[ $code -eq 12 ] && exit 0
exit $code
)",
      fmt::arg("tasks", job.tasks), fmt::arg("jobs", job.jobs), fmt::arg("merge", Quoted(merge)),
      fmt::arg("stem", Quoted((fs::absolute(job.database).parent_path() / job.database.stem())
                                  .lexically_normal()
                                  .string())),
      fmt::arg("extension", Quoted(job.database.extension().string())),
      fmt::arg("program", program), fmt::arg("sweep", Absolute(job.sweep)),
      fmt::arg("models", models));
}

}  // namespace assay::sweep
