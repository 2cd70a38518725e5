#include "tests/sim/cli/program.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>

#include "tests/oracle/json_schema.h"

namespace assay::cli {
namespace {

namespace fs = std::filesystem;

// Returns the text quoted as one word of the shell.
std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string TestName() {
  const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test->test_suite_name()) + "-" + test->name();
  std::ranges::replace(name, '/', '-');
  return name;
}

}  // namespace

std::string TextOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

nlohmann::json JsonOf(const fs::path& file) { return nlohmann::json::parse(TextOf(file)); }

Ended Run(const std::string& program, const std::vector<std::string>& arguments,
          const std::string& out) {
  const Folder streams;
  std::string command = Quoted(program);
  for (const std::string& argument : arguments) command += ' ' + Quoted(argument);
  command += " >" + Quoted(out.empty() ? streams / "out" : out) + " 2>" + Quoted(streams / "err");
  const int status = std::system(command.c_str());
  return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          .out = out.empty() ? TextOf(streams / "out") : "",
          .err = TextOf(streams / "err")};
}

Ended Assay(const std::vector<std::string>& arguments, const std::string& out) {
  return Run(ASSAY_PROGRAM, arguments, out);
}

Running::Running(const std::vector<std::string>& arguments) {
  static int count = 0;
  streams_ = fs::path(::testing::TempDir()) /
             ("assay-running-" + std::to_string(getpid()) + "-" + std::to_string(++count));
  fs::create_directories(streams_);
  const std::string out = streams_ / "out";
  const std::string err = streams_ / "err";
  std::vector<std::string> words = {ASSAY_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  process_ = fork();
  if (process_ != 0) return;
  const bool has_streams = std::freopen(out.c_str(), "w", stdout) != nullptr &&
                           std::freopen(err.c_str(), "w", stderr) != nullptr;
  if (has_streams) execv(argv.front(), argv.data());
  _exit(126);
}

Running::~Running() {
  if (process_ > 0) {
    Signal(SIGKILL);
    Wait();
  }
  std::error_code ignored;
  fs::remove_all(streams_, ignored);
}

void Running::Signal(int signal) const { kill(process_, signal); }

bool Running::Catches(int signal) const {
  static const std::string kCaught = "SigCgt:";
  std::ifstream status("/proc/" + std::to_string(process_) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with(kCaught)) continue;
    return (std::stoull(line.substr(kCaught.size()), nullptr, 16) >> (signal - 1) & 1) != 0;
  }
  return false;
}

Ended Running::Wait() {
  int status = 0;
  waitpid(std::exchange(process_, -1), &status, 0);
  return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
          .out = TextOf(streams_ / "out"),
          .err = TextOf(streams_ / "err")};
}

std::vector<std::string> SchemaErrors(const std::string& schema, const nlohmann::json& document) {
  return oracle::JsonSchema(JsonOf(kTree / schema)).Errors(document);
}

Folder::Folder() {
  static int count = 0;
  path_ = fs::path(::testing::TempDir()) /
          ("assay-" + TestName() + "-" + std::to_string(getpid()) + "-" + std::to_string(++count));
  fs::create_directories(path_);
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string Folder::Write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return path_ / name;
}

std::vector<std::string> Folder::Contents() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) {
    names.push_back(entry.path().filename());
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace assay::cli
