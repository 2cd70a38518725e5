#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/scratch_file.h"

namespace assay {

inline bool HasChromium() { return std::system("command -v chromium >/dev/null 2>&1") == 0; }

// What was seen of a page in a browser.
struct SeenPage {
  int code = -1;             // exit code of the browser
  std::string said = {};     // lines NAME=VALUE that the script has said
  std::string console = {};  // lines of the page's console
};

// Opens a page of assay view in headless Chromium in a frame of 1280 by 800 pixels, and uses it by
// a script: the body of an async function with the page's window `w` and document `d`, and with
// `say(name, value)`, `wait(ms)`, `press(key)`, `click(selector)`, which clicks on all elements
// that match and returns their number, and `picture()`, which returns what is drawn as a text. Says
// at the end how many requests the page has made. The script may wait for 8 seconds in all. They
// pass faster than in reality, so that the page is drawn only a few times in a second.
inline SeenPage UsePage(const std::filesystem::path& page, const std::string& script) {
  constexpr const char* kBegin = R"(<!DOCTYPE html><meta charset="utf-8">
<iframe id="f" src="page.html" style="width: 1280px; height: 800px"></iframe><pre id="said"></pre>
<script>
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
const said = [];
const say = (name, value) => said.push(name + "=" + value);
const use = async (w, d) => {
  const press = (key) =>
    d.body.dispatchEvent(new w.KeyboardEvent("keydown", { key, bubbles: true }));
  const click = (selector) => {
    const found = [...d.querySelectorAll(selector)];
    for (const element of found) element.click();
    return found.length;
  };
  const picture = () => {
    const { viewport } = w.assayView;
    viewport.stale = true;
    viewport.draw();
    return viewport.surface.toDataURL();
  };
)";
  constexpr const char* kEnd = R"(
  say("requests", w.performance.getEntriesByType("resource").length);
};
window.onload = async () => {
  const w = document.getElementById("f").contentWindow;
  try { await use(w, w.document); } catch (error) { say("error", error.stack); }
  document.getElementById("said").textContent = said.join("\n") + "\n";
};
</script>)";
  const auto text_of = [](const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::filesystem::path folder = ScratchFile("browser");
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(page, folder / "page.html",
                             std::filesystem::copy_options::overwrite_existing);
  std::ofstream(folder / "frame.html") << kBegin << script << kEnd;
  const std::string command =
      "timeout 120 chromium --headless --no-sandbox --no-first-run --use-angle=swiftshader "
      "--enable-unsafe-swiftshader --disable-background-networking --disable-component-update "
      "--disable-sync --host-resolver-rules='MAP * ~NOTFOUND' --enable-logging=stderr "
      "--allow-file-access-from-files --virtual-time-budget=8000 --dump-dom --user-data-dir='" +
      (folder / "profile").string() + "' 'file://" + (folder / "frame.html").string() + "' >'" +
      (folder / "out").string() + "' 2>'" + (folder / "log").string() + "'";
  SeenPage seen{.code = std::system(command.c_str())};
  const std::string out = text_of(folder / "out");
  const std::size_t begin = out.find("<pre id=\"said\">") + 15;
  seen.said = out.substr(begin, out.find("</pre>", begin) - begin);
  std::ifstream log(folder / "log");
  for (std::string line; std::getline(log, line);) {
    if (line.find(":CONSOLE") != std::string::npos) seen.console += line + "\n";
  }
  return seen;
}

}  // namespace assay
