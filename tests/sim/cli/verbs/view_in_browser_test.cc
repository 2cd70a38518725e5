#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/browser.h"
#include "tests/sim/cli/program.h"

namespace assay::cli::view_in_browser_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Uses everything that every page has: cameras, what is shown, and keys. The picture must differ
// from camera to camera.
constexpr const char* kControls = R"(
  const pictures = new Set();
  for (const camera of d.querySelectorAll('[aria-label="Camera"] button')) {
    camera.click();
    pictures.add(picture());
  }
  say("cameras", pictures.size === d.querySelectorAll('[aria-label="Camera"] button').length);
  say("toggles", click(".toggle") + click(".toggle"));
  for (const key of ["r", "b", "e", "c", "p", "Home", "End", "+", "-", ".", ","]) {
    press(key);
    press(key);
  }
  press("?"); say("help", d.querySelector("dialog").open); d.querySelector("dialog").close();
  say("drawn", picture().length > 5000);
  say("overflow", d.documentElement.scrollWidth - d.documentElement.clientWidth);
)";

// Uses what every page of an execution has.
constexpr const char* kExecution = R"(
  const details = new Set();
  const steps = [...d.querySelectorAll(".steps button")];
  for (const step of steps) {
    step.click();
    details.add(d.querySelector(".detail").textContent);
  }
  say("steps", steps.length); say("details", details.size === steps.length);
  for (const summary of d.querySelectorAll("summary")) summary.click();
  const speed = d.querySelector("select");
  for (const option of speed.options) {
    speed.value = option.value;
    speed.dispatchEvent(new w.Event("change"));
  }
  click(".controls button"); click(".controls button");
  const { player } = w.assayView;
  player.setSpeed(1); press("Home");
  press(" ");
  const plays = player.playing;
  player.pass(0.2);
  say("played", plays && player.time > player.start);
  press(" "); say("paused", !player.playing);
)";

SeenPage Used(const std::string& page, const std::string& script) {
  SeenPage seen = UsePage(page, script);
  EXPECT_EQ(seen.code, 0);
  EXPECT_THAT(seen.console, IsEmpty());
  for (const char* expected :
       {"cameras=true\n", "help=true\n", "drawn=true\n", "overflow=0\n", "requests=0\n"}) {
    EXPECT_THAT(seen.said, HasSubstr(expected));
  }
  return seen;
}

TEST(ViewInBrowser, WhyThereIsNoPlan) {
  if (!HasChromium()) GTEST_SKIP() << "chromium is not installed";
  const Folder folder;
  const std::string page = folder / "page.html";
  ASSERT_EQ(Assay({"view", kImpossible, "-o", page}).code, 10);
  const SeenPage seen = Used(page, std::string(kControls) + R"(
  const { viewport } = w.assayView;
  const ghosts = () => viewport.picture.ghosts.root.children.length;
  const reasons = [...d.querySelectorAll(".reasons button")];
  const lean = reasons.find((reason) => reason.textContent.includes("the tool would lean"));
  lean.click(); if (ghosts() === 0) lean.click();
  say("pressed", lean.getAttribute("aria-pressed"));
  say("ghosts", ghosts() >= 3);
  say("excess", lean.querySelector("small").textContent);
  const shown = picture();
  lean.click(); say("hidden", ghosts() === 0 && picture() !== shown);
  for (const reason of reasons) reason.click();
  say("hypothesis", reasons.some((reason) => reason.textContent.startsWith("grasps:")));
)");
  for (const char* expected : {"pressed=true\n", "ghosts=true\n", "at most 10° is allowed",
                               "hidden=true\n", "hypothesis=false\n"}) {
    EXPECT_THAT(seen.said, HasSubstr(expected));
  }
}

TEST(ViewInBrowser, APlanTree) {
  if (!HasChromium()) GTEST_SKIP() << "chromium is not installed";
  const Folder folder;
  const std::string page = folder / "page.html";
  const std::string bottles = kTree / "scenarios/bottles.yaml";
  ASSERT_EQ(Assay({"view", bottles, "2", "--worlds", "all", "-o", page}).code, 0);
  const SeenPage seen = Used(page, std::string(kControls) + kExecution + R"(
  say("left", d.querySelectorAll(".tree .left").length > 0);
)");
  for (const char* expected : {"details=true\n", "played=true\n", "paused=true\n", "left=true\n"}) {
    EXPECT_THAT(seen.said, HasSubstr(expected));
  }
}

TEST(ViewInBrowser, AMating) {
  if (!HasChromium()) GTEST_SKIP() << "chromium is not installed";
  const Folder folder;
  const std::string page = folder / "page.html";
  ASSERT_EQ(Assay({"mate", kTree / "scenarios/mate-square.yaml", "--view", page}).code, 0);
  const SeenPage seen = Used(page, std::string(kControls) + kExecution + R"(
  say("graph", d.querySelector(".drawing svg") !== null);
  say("facts", d.querySelector(".facts").textContent.includes("errors at its end"));
)");
  for (const char* expected :
       {"details=true\n", "played=true\n", "paused=true\n", "graph=true\n", "facts=true\n"}) {
    EXPECT_THAT(seen.said, HasSubstr(expected));
  }
}

}  // namespace
}  // namespace assay::cli::view_in_browser_test
