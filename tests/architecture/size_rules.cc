#include "tests/architecture/size_rules.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string_view>

#include "tests/architecture/library_table.h"

namespace assay::architecture {
namespace {

namespace fs = std::filesystem;

std::string TextOf(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

int LineCount(const std::string& text) { return static_cast<int>(std::ranges::count(text, '\n')); }

std::string Breach(const std::string& file, int line, const std::string& what, int lines) {
  return file + ':' + std::to_string(line) + ": " + what + " of " + std::to_string(lines) +
         " lines";
}

// Returns the names of the .h and .cc files under planner/ and sim/, from the root, sorted.
std::vector<std::string> SourcesOf(const fs::path& root) {
  std::vector<std::string> names;
  for (const char* top : {"planner", "sim"}) {
    if (!fs::exists(root / top)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cc") continue;
      names.push_back(fs::relative(entry.path(), root).generic_string());
    }
  }
  std::ranges::sort(names);
  return names;
}

// Returns the place behind the comment, literal or directive of the preprocessor that begins at
// `at`, or `at` itself if none begins there.
std::size_t EndOfNoCode(const std::string& text, std::size_t at) {
  const auto behind = [&](const std::string& end, std::size_t from) {
    const std::size_t found = text.find(end, from);
    return found == std::string::npos ? text.size() : found + end.size();
  };
  const std::string_view rest = std::string_view(text).substr(at);
  if (rest.starts_with("//") || rest.starts_with('#')) return behind("\n", at) - 1;
  if (rest.starts_with("/*")) return behind("*/", at + 2);
  if (rest.starts_with("R\"")) {
    return behind(')' + text.substr(at + 2, text.find('(', at) - at - 2) + '"', at);
  }
  // A quote between the digits of a number begins no literal.
  const bool is_quote = rest[0] == '\'' && (at == 0 || std::isalnum(text[at - 1]) == 0);
  if (rest[0] != '"' && !is_quote) return at;
  std::size_t end = at + 1;
  while (end < text.size() && text[end] != rest[0]) end += text[end] == '\\' ? 2 : 1;
  return end + 1;
}

// Returns the text without comments, literals and directives, but with all line breaks.
std::string CodeAlone(const std::string& text) {
  std::string code;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(EndOfNoCode(text, at), text.size());
    if (end == at) {
      code += text[at++];
    } else {
      const auto lines = std::count(text.begin() + at, text.begin() + end, '\n');
      code.append(static_cast<std::size_t>(lines), '\n');
      at = end;
    }
  }
  return code;
}

enum class BlockKind { kClass, kFunction, kOther };

// A part of a source file between two braces.
struct Block {
  BlockKind kind = BlockKind::kOther;
  int first = 0;  // the line of the opening brace
  int last = 0;   // the line of the closing brace

  int lines() const { return last - first - 1; }
};

// Returns the kind of the block that follows `head`, the code since the last brace or semicolon.
BlockKind KindOf(const std::string& head) {
  static const std::regex kClassHead(R"(\b(class|struct|union)\s[^=()]*$)");
  static const std::regex kOtherHead(R"(=\s*$|^\s*(enum|namespace)\b)");
  if (std::regex_search(head, kOtherHead)) return BlockKind::kOther;
  if (std::regex_search(head, kClassHead)) return BlockKind::kClass;
  return head.find(')') == std::string::npos ? BlockKind::kOther : BlockKind::kFunction;
}

// Returns the blocks of a file. Blocks inside of a function have no kind.
std::vector<Block> BlocksOf(const fs::path& file) {
  std::vector<Block> open;
  std::vector<Block> closed;
  std::string head;
  int line = 1;
  for (const char c : CodeAlone(TextOf(file))) {
    if (c == '\n') ++line;
    if (c == '{') {
      const bool is_inside = std::ranges::any_of(
          open, [](const Block& block) { return block.kind == BlockKind::kFunction; });
      open.push_back({.kind = is_inside ? BlockKind::kOther : KindOf(head), .first = line});
    } else if (c == '}' && !open.empty()) {
      open.back().last = line;
      closed.push_back(open.back());
      open.pop_back();
    }
    if (c == '{' || c == '}' || c == ';') {
      head.clear();
    } else {
      head += c;
    }
  }
  return closed;
}

std::vector<std::string> LongBlocks(const fs::path& root, BlockKind kind, const std::string& what,
                                    const std::string& extension, int most) {
  std::vector<std::string> breaches;
  for (const std::string& name : SourcesOf(root)) {
    if (!name.ends_with(extension)) continue;
    for (const Block& block : BlocksOf(root / name)) {
      if (block.kind != kind || block.lines() <= most) continue;
      breaches.push_back(Breach(name, block.first, what, block.lines()));
    }
  }
  return breaches;
}

}  // namespace

std::vector<std::string> LongFiles(const fs::path& root, int most) {
  std::vector<std::string> breaches;
  for (const std::string& name : SourcesOf(root)) {
    const int lines = LineCount(TextOf(root / name));
    if (lines > most) breaches.push_back(Breach(name, 1, "a file", lines));
  }
  return breaches;
}

std::vector<std::string> LongFunctions(const fs::path& root, int most) {
  return LongBlocks(root, BlockKind::kFunction, "a function", "", most);
}

std::vector<std::string> LongClasses(const fs::path& root, int most) {
  return LongBlocks(root, BlockKind::kClass, "a class", ".cc", most);
}

std::vector<std::string> LongReadmes(const fs::path& root, int most) {
  std::vector<std::string> folders = LibraryTable::Read(root).folders();
  for (const fs::directory_entry& entry : fs::directory_iterator(root)) {
    if (entry.is_directory()) folders.push_back(entry.path().filename().string());
  }
  std::ranges::sort(folders);
  std::vector<std::string> breaches;
  for (const std::string& folder : folders) {
    const int lines = LineCount(TextOf(root / folder / "README.md"));
    if (lines > most) breaches.push_back(Breach(folder + "/README.md", 1, "a README", lines));
  }
  return breaches;
}

std::vector<std::string> LongRootReadme(const fs::path& root, int most_lines, int most_words) {
  const std::string text = TextOf(root / "README.md");
  std::istringstream in(text);
  const auto words = std::distance(std::istream_iterator<std::string>(in), {});
  if (LineCount(text) <= most_lines && words <= most_words) return {};
  return {"README.md:1: " + std::to_string(LineCount(text)) + " lines, " + std::to_string(words) +
          " words"};
}

}  // namespace assay::architecture
