#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <utility>

#include "tests/architecture/library_table.h"

namespace assay::architecture {
namespace {

namespace fs = std::filesystem;

struct Include {
  int line = 0;
  bool quoted = false;  // "..." rather than <...>
  std::string name;
};

struct SourceFile {
  std::string name;  // path from the root
  std::vector<Include> includes;

  bool is_header() const { return name.ends_with(".h"); }
};

std::vector<Include> ReadIncludes(const fs::path& file) {
  static const std::regex kInclude(R"re(^\s*#\s*include\s*([<"])([^">]+)[">].*)re");
  std::vector<Include> includes;
  std::ifstream in(file);
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    std::smatch match;
    if (!std::regex_match(text, match, kInclude)) continue;
    includes.push_back({.line = line, .quoted = match[1] == "\"", .name = match[2]});
  }
  return includes;
}

// Returns the .h and .cc files in `folder` and below it, sorted by name.
std::vector<SourceFile> SourcesIn(const fs::path& root, const std::string& folder) {
  std::vector<SourceFile> sources;
  if (!fs::exists(root / folder)) return sources;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cc") continue;
    sources.push_back({.name = fs::relative(entry.path(), root).generic_string(),
                       .includes = ReadIncludes(entry.path())});
  }
  std::ranges::sort(sources, {}, &SourceFile::name);
  return sources;
}

std::vector<SourceFile> LibrarySources(const fs::path& root) {
  std::vector<SourceFile> sources;
  for (const char* top : {"planner", "sim", "bench/workloads"}) {
    std::ranges::move(SourcesIn(root, top), std::back_inserter(sources));
  }
  return sources;
}

std::vector<SourceFile> AllSources(const fs::path& root) {
  std::vector<SourceFile> sources;
  for (const char* top : {"planner", "sim", "bench"}) {
    std::ranges::move(SourcesIn(root, top), std::back_inserter(sources));
  }
  return sources;
}

std::string WithoutExtension(const std::string& file) {
  return fs::path(file).replace_extension().generic_string();
}

// Keys and values are file names without extension.
using IncludeGraph = std::map<std::string, std::set<std::string>>;

std::set<std::string> ReachedFrom(const std::string& file, const IncludeGraph& graph) {
  std::set<std::string> reached;
  std::vector<std::string> open = {file};
  while (!open.empty()) {
    const auto included = graph.find(open.back());
    open.pop_back();
    if (included == graph.end()) continue;
    for (const std::string& other : included->second) {
      if (reached.insert(other).second) open.push_back(other);
    }
  }
  return reached;
}

std::string Breach(const SourceFile& source, const Include& include, const std::string& what) {
  return source.name + ':' + std::to_string(include.line) + ": " + include.name + ": " + what;
}

bool StartsWithAny(const std::string& name, std::initializer_list<const char*> starts) {
  return std::ranges::any_of(starts, [&](const char* start) { return name.starts_with(start); });
}

}  // namespace

std::vector<std::string> CrossedBorders(const fs::path& root) {
  const LibraryTable table = LibraryTable::Read(root);
  std::vector<std::string> breaches;
  for (const SourceFile& source : LibrarySources(root)) {
    const std::string folder = table.FolderOf(source.name);
    if (folder.empty()) continue;
    const std::set<std::string> open = table.OpenTo(folder);
    for (const Include& include : source.includes) {
      const bool ours = StartsWithAny(include.name, {"planner/", "sim/", "bench/", "tests/"});
      if (include.quoted && !ours) {
        breaches.push_back(Breach(source, include, "is not written from the root"));
      } else if (ours && !open.contains(table.FolderOf(include.name))) {
        breaches.push_back(Breach(source, include, "is not of a library that " + folder + " uses"));
      }
    }
  }
  return breaches;
}

std::vector<std::string> CrossedMujocoLine(const fs::path& root) {
  std::vector<std::string> breaches;
  for (const SourceFile& source : SourcesIn(root, "planner")) {
    for (const Include& include : source.includes) {
      if (!StartsWithAny(include.name, {"sim/", "mujoco/", "GL/", "EGL/", "GLFW/", "opencv2/"}))
        continue;
      breaches.push_back(Breach(source, include, "the planner knows no simulator"));
    }
  }
  return breaches;
}

std::vector<std::string> OwnHeaderNotFirst(const fs::path& root) {
  std::vector<std::string> breaches;
  for (const SourceFile& source : LibrarySources(root)) {
    const std::string header = fs::path(source.name).replace_extension(".h").generic_string();
    if (source.is_header() || !fs::exists(root / header)) continue;
    if (!source.includes.empty() && source.includes.front().name == header) continue;
    breaches.push_back(source.name + ":1: does not include " + header + " first");
  }
  return breaches;
}

std::vector<std::string> HeavyHeaders(const fs::path& root) {
  std::vector<std::string> breaches;
  for (const SourceFile& source : LibrarySources(root)) {
    if (!source.is_header()) continue;
    for (const Include& include : source.includes) {
      if (!StartsWithAny(include.name, {"fcl/", "ompl/", "assimp/", "STEPControl", "urdf_",
                                        "libqhull", "yaml-cpp/", "opencv2/", "gmpxx.h"})) {
        continue;
      }
      breaches.push_back(Breach(source, include, "belongs into the .cc file"));
    }
  }
  return breaches;
}

std::vector<std::string> FilesOfNoLibrary(const fs::path& root) {
  const LibraryTable table = LibraryTable::Read(root);
  std::vector<std::string> breaches;
  for (const SourceFile& source : LibrarySources(root)) {
    if (!table.FolderOf(source.name).empty()) continue;
    breaches.push_back(source.name + ":1: no line of the table of libraries covers it");
  }
  return breaches;
}

std::vector<std::string> UnusedLibraries(const fs::path& root) {
  const LibraryTable table = LibraryTable::Read(root);
  std::set<std::pair<std::string, std::string>> used;
  for (const SourceFile& source : AllSources(root)) {
    for (const Include& include : source.includes) {
      used.emplace(table.FolderOf(source.name), table.FolderOf(include.name));
    }
  }
  std::vector<std::string> breaches;
  for (const std::string& folder : table.folders()) {
    for (const std::string& other : table.UsesOf(folder)) {
      if (used.contains({folder, other})) continue;
      breaches.push_back("CMakeLists.txt:1: " + folder + " includes nothing of " + other);
    }
  }
  return breaches;
}

std::vector<std::string> Cycles(const fs::path& root) {
  IncludeGraph graph;
  for (const SourceFile& source : AllSources(root)) {
    for (const Include& include : source.includes) {
      if (WithoutExtension(include.name) != WithoutExtension(source.name)) {
        graph[WithoutExtension(source.name)].insert(WithoutExtension(include.name));
      }
    }
  }
  std::map<std::string, std::set<std::string>> reached;
  for (const auto& [file, included] : graph) reached[file] = ReachedFrom(file, graph);
  std::set<std::string> cycles;
  for (const auto& [file, others] : reached) {
    if (!others.contains(file)) continue;
    std::string cycle;
    for (const std::string& other : others) {
      if (reached[other].contains(file)) cycle += (cycle.empty() ? "" : " ") + other;
    }
    cycles.insert(cycle);
  }
  return {cycles.begin(), cycles.end()};
}

std::vector<std::string> CrowdedFolders(const fs::path& root, int most) {
  std::map<std::string, int> counts;
  for (const SourceFile& source : AllSources(root)) {
    ++counts[fs::path(source.name).parent_path().generic_string()];
  }
  std::vector<std::string> breaches;
  for (const auto& [folder, count] : counts) {
    if (count <= most) continue;
    breaches.push_back(folder + ": " + std::to_string(count) + " source files");
  }
  return breaches;
}

}  // namespace assay::architecture
