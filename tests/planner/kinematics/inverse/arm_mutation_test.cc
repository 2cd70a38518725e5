#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "planner/base/input_files/input_error.h"
#include "planner/base/random.h"
#include "planner/kinematics/inverse/chain_inverse.h"
#include "tests/scratch_file.h"

namespace assay::kinematics::arm_mutation_test {
namespace {

int MutationCount() {
  const char* count = std::getenv("ASSAY_MUTATIONS");
  return count == nullptr ? 1000 : std::atoi(count);
}

std::size_t AnyIndex(RandomStream& random, std::size_t size) {
  return static_cast<std::size_t>(random.Index(static_cast<int>(size)));
}

void ReplaceNumber(std::string& text, RandomStream& random) {
  constexpr std::array<const char*, 10> kNumbers = {"0",   "-1",   "1e308", "nan",        "inf",
                                                    "1e9", "1e-9", "0.05",  "1.57079633", "1.5708"};
  constexpr const char* kDigits = "0123456789.e-";
  const std::size_t begin = text.find_first_of("0123456789", AnyIndex(random, text.size()));
  if (begin == std::string::npos) return;
  const std::size_t end = text.find_first_not_of(kDigits, begin);
  text.replace(begin, end - begin, kNumbers[AnyIndex(random, kNumbers.size())]);
}

void Damage(std::string& text, RandomStream& random) {
  constexpr std::array<const char*, 7> kWords = {
      "continuous", "fixed", "prismatic", "<mimic joint=\"elbow\"/>", "<axis xyz=\"0 1 1\"/>",
      "\"",         "<"};
  const std::size_t at = AnyIndex(random, text.size());
  switch (random.Index(8)) {
    case 0:
      text[at] = static_cast<char>(random.Index(256));
      return;
    case 1:
      text.erase(at, AnyIndex(random, 40));
      return;
    case 2:
      text.insert(at, kWords[AnyIndex(random, kWords.size())]);
      return;
    default:
      ReplaceNumber(text, random);
  }
}

// Solves the pose of one posture. General arms take a hundred times as long to solve as others, and
// only some of them are solved.
void Solve(const SerialChain& chain, int trial) {
  const ChainVector q = ChainVector::Constant(chain.size(), 0.3);
  const SerialChain six = chain.size() == 7 ? chain.Locked(2, q[2]) : chain;
  const ArmClass arm = ClassOf(six);
  if ((arm.kind == ArmKind::kGeneral || !arm.IsExact()) && trial % 20 != 0) return;
  const Pose X = chain.Forward(q);
  for (const SixAngles& solution : ChainInverse(six).Solve(X)) {
    const double error = (six.Forward(solution).matrix() - X.matrix()).cwiseAbs().maxCoeff();
    EXPECT_LT(error, 1e-9) << trial;
  }
}

// A damaged file is refused with an InputError, or taken: then its arm is solved. The variable
// ASSAY_MUTATIONS sets another number of files, like 10000. A crash leaves the last file in the
// temporary folder.
TEST(ArmMutations, AreRefusedOrSolved) {
  std::ifstream in(ASSAY_SOURCE_DIR "/models/robots/puma762/puma762.urdf");
  const std::string original(std::istreambuf_iterator<char>(in), {});
  const std::filesystem::path file = ScratchFile("damaged.urdf");
  RandomStream random(20261126, "urdf");
  const int count = MutationCount();
  int taken = 0;
  for (int trial = 0; trial < count; ++trial) {
    std::string text = original;
    for (int slips = random.Index(5); slips >= 0; --slips) Damage(text, random);
    std::ofstream(file, std::ios::binary) << text;
    try {
      Solve(SerialChain::FromModel(ReadUrdf(file, UrdfContents::kAxes)), trial);
      ++taken;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("damaged.urdf"), std::string::npos)
          << trial << ": " << error.what();
    }
  }
  EXPECT_GT(taken, count / 10);
  EXPECT_LT(taken, count * 9 / 10);
}

}  // namespace
}  // namespace assay::kinematics::arm_mutation_test
