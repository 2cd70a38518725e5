#include "sim/report/html/page.h"

#include <fmt/format.h>

#include "planner/base/input_files/document.h"
#include "planner/base/input_files/input_error.h"
#include "sim/report/charts/chart.h"
#include "sim/report/html/head.h"
#include "sim/report/numbers/figures.h"
#include "sim/report/sections/section.h"

namespace assay::report {
namespace {

constexpr const char* kPictureId = "pictures";
constexpr const char* kPictureTitle = "Best, typical and worst trial";

// Returns the sweep file's title. If the file has no title, or if this version of the program
// cannot read the file, returns its path.
std::string TitleOf(const Findings& findings) {
  const auto text = findings.facts.find("text");
  const auto path = findings.facts.find("path");
  const std::string name = path == findings.facts.end() ? findings.database : path->second;
  if (text == findings.facts.end()) return name;
  try {
    const auto title = Document::Parse(text->second, name).root().Find("title");
    return title ? title->Text() : name;
  } catch (const InputError&) {
    return name;
  }
}

std::string AboutText(const Findings& findings) {
  std::string text =
      fmt::format("Plans executed in physics: {} in {}", CountText(findings.done(), "trial"),
                  CountText(static_cast<std::int64_t>(findings.cells.size()), "cell"));
  if (findings.runs.empty()) return text;
  const sweep::RunRecord& run = findings.runs.front();
  return text + fmt::format(", from {} on {} (assay {})", run.started.substr(0, 10), run.machine,
                            run.version);
}

Element PageHeader(const Findings& findings, const std::string& title, bool pictures) {
  Element header("header");
  header.Add("h1", title);
  header.Add("p", AboutText(findings)).Set("class", "about");
  if (findings.done() < findings.trials()) {
    header
        .Add("p", fmt::format("The sweep is not finished: {} of {} are in the database.",
                              CountText(findings.done()), CountText(findings.trials(), "trial")))
        .Set("class", "warning");
  }
  Element& list = header.Add("nav").Set("aria-label", "Sections").Add("ul");
  const auto add = [&](const std::string& id, const std::string& name) {
    list.Add("li").Add("a", name).Set("href", "#" + id);
  };
  for (const Section& section : Sections()) add(section.id, section.title);
  if (pictures) add(kPictureId, kPictureTitle);
  return header;
}

void AddSection(Element& main, const std::string& id, const std::string& title, Element contents) {
  Element& section = main.Add("section").Set("id", id).Set("aria-labelledby", id + "-title");
  section.Add("h2", title).Set("id", id + "-title");
  section.Add(std::move(contents));
}

Element Main(const Subject& subject, const PageOptions& options) {
  Element main("main");
  main.Set("id", "main");
  for (const Section& section : Sections()) {
    AddSection(main, section.id, section.title, section.make(subject));
  }
  if (options.picture) {
    AddSection(main, kPictureId, kPictureTitle, Pictures(subject.findings, options.picture));
  }
  return main;
}

}  // namespace

std::string Page(const Findings& findings, const PageOptions& options) {
  const std::string title = TitleOf(findings);
  Element page("html");
  page.Set("lang", "en").Add(Head(title));
  Element& body = page.Add("body");
  body.Add("a", "Skip to the contents").Set("class", "skip").Set("href", "#main");
  body.Add(MarkDefinitions());
  body.Add(PageHeader(findings, title, static_cast<bool>(options.picture)));
  Subject subject = SubjectOf(findings, options.cells_in_full);
  subject.view = options.view;
  body.Add(Main(subject, options));
  body.Add(
      "footer",
      "Intervals of rates are Wilson's, for 95 %. Lengths are in millimetres, angles in degrees. "
      "“Not violated” means that this number of tests did not falsify the prediction.");
  return "<!DOCTYPE html>\n" + page.Markup() + "\n";
}

}  // namespace assay::report
