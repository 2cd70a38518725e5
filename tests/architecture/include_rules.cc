#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <fstream>
#include <regex>

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
  std::string name;  // from the root
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

// The .h and .cc files in `folder` of the tree and below, by name.
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
      if (!StartsWithAny(include.name, {"fcl/", "ompl/", "urdf_", "libqhull", "yaml-cpp/",
                                        "opencv2/", "gmpxx.h"})) {
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
    if (!table.FolderOf(source.name).empty() || source.name.starts_with("sim/cli/")) continue;
    breaches.push_back(source.name + ":1: no line of the table of libraries covers it");
  }
  return breaches;
}

}  // namespace assay::architecture
