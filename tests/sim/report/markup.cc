#include "tests/sim/report/markup.h"

#include <cctype>
#include <stdexcept>

namespace assay::report {
namespace {

class Reader {
 public:
  explicit Reader(const std::string& page) : page_(page) {}

  Markup Read() {
    constexpr std::string_view kType = "<!DOCTYPE html>\n";
    if (!page_.starts_with(kType)) Fail("no document type");
    at_ = kType.size();
    Markup root = ReadElement();
    while (at_ < page_.size() && page_[at_] == '\n') ++at_;
    if (at_ != page_.size()) Fail("something after the end");
    return root;
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw std::runtime_error(what + " at " + std::to_string(at_) + ": " + page_.substr(at_, 60));
  }
  char Next() const { return at_ < page_.size() ? page_[at_] : '\0'; }
  bool Skip(std::string_view text) {
    if (page_.compare(at_, text.size(), text) != 0) return false;
    at_ += text.size();
    return true;
  }
  void Expect(std::string_view text) {
    if (!Skip(text)) Fail("no " + std::string(text));
  }

  std::string ReadName() {
    std::string name;
    while (std::isalnum(static_cast<unsigned char>(Next())) != 0 || Next() == '-') {
      name += page_[at_++];
    }
    if (name.empty()) Fail("no name");
    return name;
  }

  std::string ReadEntity() {
    static const std::map<std::string, std::string> kEntities = {
        {"&amp;", "&"}, {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}};
    for (const auto& [entity, meaning] : kEntities) {
      if (Skip(entity)) return meaning;
    }
    Fail("a bare &");
  }

  std::string ReadText(std::string_view end) {
    std::string text;
    while (at_ < page_.size() && end.find(Next()) == end.npos) {
      if (Next() == '>' || Next() == '<') Fail("a bare bracket");
      text += Next() == '&' ? ReadEntity() : std::string(1, page_[at_++]);
    }
    return text;
  }

  Markup ReadElement() {
    Expect("<");
    Markup element{.name = ReadName()};
    while (Skip(" ") && Next() != '/') {
      const std::string name = ReadName();
      Expect("=\"");
      if (!element.attributes.emplace(name, ReadText("\"")).second) Fail("twice " + name);
      Expect("\"");
    }
    if (Skip("/>")) return element;
    Expect(">");
    ReadContents(element);
    return element;
  }

  void ReadContents(Markup& element) {
    while (!Skip("</" + element.name + ">")) {
      if (at_ >= page_.size()) Fail("open: " + element.name);
      if (Next() == '<') {
        element.children.push_back(ReadElement());
        element.text += element.children.back().text;
      } else {
        element.text += ReadText("<");
      }
    }
  }

  const std::string& page_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<const Markup*> Markup::All(std::string_view element) const {
  std::vector<const Markup*> all;
  for (const Markup& child : children) {
    if (child.name == element) all.push_back(&child);
    for (const Markup* inner : child.All(element)) all.push_back(inner);
  }
  return all;
}

const Markup* Markup::WithId(const std::string& id) const {
  for (const Markup& child : children) {
    if (const auto found = child.attributes.find("id");
        found != child.attributes.end() && found->second == id) {
      return &child;
    }
    if (const Markup* const inner = child.WithId(id)) return inner;
  }
  return nullptr;
}

Markup ReadMarkup(const std::string& page) { return Reader(page).Read(); }

}  // namespace assay::report
