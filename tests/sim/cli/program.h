#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace assay::cli {

inline const std::filesystem::path kTree = ASSAY_SOURCE_DIR;
// Pickup of the peg, assemble; known so well that nothing is inserted.
inline const std::string kTwoActions = kTree / "scenarios/uncertain-known.yaml";
// The same with a look at each part.
inline const std::string kTwoLooks = kTree / "scenarios/uncertain-sensing.yaml";
// Two squeezes of a post, pickup of a sleeve, assemble.
inline const std::string kTwoSqueezes = kTree / "scenarios/uncertain-squeezing.yaml";
// Pickup and assemble, neither of which can be proved.
inline const std::string kUnproved = kTree / "scenarios/uncertain-failing.yaml";
// A look, a pickup, and assemble by fine motion.
inline const std::string kFelt = kTree / "scenarios/uncertain-fine-motion.yaml";
inline const std::string kImpossible = kTree / "scenarios/impossible.yaml";

// What the program left behind.
struct Ended {
  int code = -1;  // of its exit; -1: it did not exit by itself
  std::string out;
  std::string err;

  nlohmann::json Json() const { return nlohmann::json::parse(out); }
};

// Runs a program. `out`: where its standard output goes instead of into Ended::out.
Ended Run(const std::string& program, const std::vector<std::string>& arguments,
          const std::string& out = "");
// Runs the built program.
Ended Assay(const std::vector<std::string>& arguments, const std::string& out = "");

// The built program while it runs, with files for its streams.
class Running {
 public:
  explicit Running(const std::vector<std::string>& arguments);
  ~Running();  // kills it if nobody has waited
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void Signal(int signal) const;
  // Whether it has a handler for the signal by now, which so far would end it at once (proc(5)).
  bool Catches(int signal) const;
  // Its end; `code` is that of its exit, or the negative of the signal that ended it.
  Ended Wait();

 private:
  std::filesystem::path streams_;
  int process_ = -1;
};

std::string TextOf(const std::filesystem::path& file);
nlohmann::json JsonOf(const std::filesystem::path& file);

// What is wrong with the document by a schema of the source tree.
std::vector<std::string> SchemaErrors(const std::string& schema, const nlohmann::json& document);

// A folder of its own for each test, removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return path_ / name; }
  std::string Write(const std::string& name, const std::string& text) const;
  std::vector<std::string> Contents() const;  // names, sorted

 private:
  std::filesystem::path path_;
};

}  // namespace assay::cli
