#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "sim/view/page.h"
#include "tests/scratch_file.h"
#include "tests/sim/view/viewed_execution.h"

namespace assay::view::browser_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string TextOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Opens the page in a frame of 1280 by 800 pixels, uses it as people do, and lists what it shows.
// The first step of figure 15 is a look without a movement, so the page begins in the second one.
constexpr const char* kFrame = R"(<!DOCTYPE html><meta charset="utf-8">
<iframe id="f" src="page.html" style="width: 1280px; height: 800px"></iframe><pre id="seen"></pre>
<script>
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
const seen = [];
const say = (name, value) => seen.push(name + "=" + value);
const use = async (w, d) => {
  const clock = () => Number(d.querySelector(".clock").textContent.split(" ")[0]);
  const press = (key) =>
    d.body.dispatchEvent(new w.KeyboardEvent("keydown", { key, bubbles: true }));
  const step = () => d.querySelector('[aria-current="step"] .number').textContent;
  const picture = () => {
    const { viewport } = w.assayView;
    viewport.stale = true;
    viewport.draw();
    return viewport.surface.toDataURL();
  };
  press(" "); await wait(2000); press(" ");
  const paused = clock();
  await wait(300);
  say("played", paused > 0); say("paused", clock() === paused);
  d.querySelectorAll(".steps button")[1].click();
  say("clicked", step()); say("lead", d.querySelector(".lead").textContent);
  say("claims", d.querySelectorAll(".claim").length > 5);
  press("Home"); say("home", clock());
  press("ArrowDown"); say("next", step());
  press("ArrowRight"); press("."); press("ArrowUp"); say("again", step());
  press("End"); say("end", clock() > 5);
  press("+"); say("speed", d.querySelector("select").value);
  const whole = picture();
  press("4"); say("camera", d.querySelector('.group [aria-pressed="true"]').textContent);
  const above = picture();
  press("b"); say("pictures", whole.length > 5000 && above !== whole && picture() !== above);
  press("p"); say("beside", d.querySelector(".half[hidden]") !== null);
  press("?"); say("help", d.querySelector("dialog").open);
  say("overflow", d.documentElement.scrollWidth - d.documentElement.clientWidth);
  say("requests", w.performance.getEntriesByType("resource").length);
};
window.onload = async () => {
  const w = document.getElementById("f").contentWindow;
  try { await use(w, w.document); } catch (error) { say("error", error.stack); }
  document.getElementById("seen").textContent = seen.join("\n");
};
</script>)";

Subject TwoExecutions() {
  Subject subject = Figure15().subject();
  subject.beside.emplace("the same again", Figure15().scene, Figure15().trace);
  return subject;
}

TEST(InBrowser, IsUsedAsPeopleDo) {
  if (std::system("command -v chromium >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "chromium is not installed";
  }
  std::ofstream(ScratchFile("page.html"), std::ios::binary) << Page(TwoExecutions());
  std::ofstream(ScratchFile("frame.html")) << kFrame;
  const std::string command =
      "timeout 120 chromium --headless --no-sandbox --no-first-run --use-angle=swiftshader "
      "--enable-unsafe-swiftshader --disable-background-networking --disable-component-update "
      "--disable-sync --host-resolver-rules='MAP * ~NOTFOUND' --enable-logging=stderr "
      "--allow-file-access-from-files --virtual-time-budget=8000 --dump-dom --user-data-dir='" +
      ScratchFile("profile").string() + "' 'file://" + ScratchFile("frame.html").string() + "' >'" +
      ScratchFile("out").string() + "' 2>'" + ScratchFile("log").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << TextOf(ScratchFile("log"));
  EXPECT_THAT(TextOf(ScratchFile("log")), Not(HasSubstr(":CONSOLE")));
  const std::string seen = TextOf(ScratchFile("out"));
  for (const char* expected :
       {"played=true\n", "paused=true\n", "clicked=2\n", "to spare.\n", "claims=true\n", "home=0",
        "next=3\n", "again=3\n", "end=true\n", "speed=2\n", "camera=top\n", "pictures=true\n",
        "beside=true\n", "help=true\n", "overflow=0\n", "requests=0</pre>"}) {
    EXPECT_THAT(seen, HasSubstr(expected));
  }
}

}  // namespace
}  // namespace assay::view::browser_test
