#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace assay::cli {

inline const std::filesystem::path kTree = ASSAY_SOURCE_DIR;
// The steps are a pickup of the peg and an assembly. Poses are known so well that nothing is
// inserted.
inline const std::string kTwoActions = kTree / "scenarios/uncertain-known.yaml";
// The steps are a look at each part, a pickup and an assembly.
inline const std::string kTwoLooks = kTree / "scenarios/uncertain-sensing.yaml";
// The steps are two squeezes of a post, a pickup of a sleeve and an assembly.
inline const std::string kTwoSqueezes = kTree / "scenarios/uncertain-squeezing.yaml";
// The steps are a pickup and an assembly, neither of which can be proved.
inline const std::string kUnproved = kTree / "scenarios/uncertain-failing.yaml";
// The steps are a look, a pickup, and an assembly by fine motion.
inline const std::string kFelt = kTree / "scenarios/uncertain-fine-motion.yaml";
inline const std::string kImpossible = kTree / "scenarios/impossible.yaml";

// The result of a program that has ended.
struct Ended {
  int code = -1;  // exit code; -1 if a signal ended the program
  std::string out;
  std::string err;

  nlohmann::json Json() const { return nlohmann::json::parse(out); }
};

// Runs a program. Its standard output goes to the file `out`, or to Ended::out if `out` is empty.
Ended Run(const std::string& program, const std::vector<std::string>& arguments,
          const std::string& out = "");
// Runs the built program. The meaning of `out` is that of Run.
Ended Assay(const std::vector<std::string>& arguments, const std::string& out = "");

// The built program while it runs. Its streams go to files.
class Running {
 public:
  explicit Running(const std::vector<std::string>& arguments);
  ~Running();  // kills the program unless Wait was called
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void Signal(int signal) const;
  // Returns whether the program has a handler for the signal yet (proc(5)). Before that, the signal
  // ends the program at once.
  bool Catches(int signal) const;
  // Waits for the end. `code` is the exit code, or minus the number of the signal that ended it.
  Ended Wait();

 private:
  std::filesystem::path streams_;
  int process_ = -1;
};

std::string TextOf(const std::filesystem::path& file);
nlohmann::json JsonOf(const std::filesystem::path& file);

// Returns the breaches of a schema of the source tree by the document. Empty means valid.
std::vector<std::string> SchemaErrors(const std::string& schema, const nlohmann::json& document);

// A temporary folder of a test. It is removed with the object.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return path_ / name; }
  std::string Write(const std::string& name, const std::string& text) const;
  std::vector<std::string> Contents() const;  // sorted names

 private:
  std::filesystem::path path_;
};

}  // namespace assay::cli
