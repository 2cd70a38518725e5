#include "planner/contingent/pks_and_pddl/pks_effects.h"

#include <fmt/format.h>

#include <utility>

#include "planner/contingent/pks_and_pddl/pks_formula.h"

namespace assay::contingent {
namespace {

bool BeginsChange(const PksTokens& tokens) {
  return (tokens.Peek().IsName("add") || tokens.Peek().IsName("del")) && tokens.Peek(1).Is("(");
}

// alternatives = literal { "|" literal } | "some" "(" literal { "|" literal } ")"
void ReadAlternatives(PksTokens& tokens, Change& change) {
  change.is_inclusive = tokens.Peek(1).Is("(") && tokens.TakeWordIf("some");
  if (change.is_inclusive) tokens.Expect("(");
  change.literals = tokens.List("|", [&] { return ReadLiteral(tokens); });
  if (change.is_inclusive) tokens.Expect(")");
}

Change ReadChange(PksTokens& tokens) {
  if (!BeginsChange(tokens)) tokens.FailAtNext("add(STORE, ...) or del(STORE, ...)");
  Change change;
  change.place = tokens.Peek().place;
  change.is_addition = tokens.Take().text == "add";
  tokens.Expect("(");
  const Token store = tokens.ExpectName("Kf, Kw, Kv, Kx or LCW");
  tokens.Expect(",");
  if (store.text == "Kf") {
    change.store = Store::kFacts;
    change.literals.push_back(ReadLiteral(tokens));
  } else if (store.text == "Kw") {
    change.store = Store::kWhether;
    change.literals = ReadConjunction(tokens);
  } else if (store.text == "Kv") {
    change.store = Store::kValues;
    change.terms.push_back(ReadTerm(tokens));
    change.within = ReadWithin(tokens);
  } else if (store.text == "Kx") {
    change.store = Store::kExclusive;
    ReadAlternatives(tokens, change);
  } else if (store.text == "LCW") {
    change.store = Store::kClosed;
    change.literals.push_back(ReadLiteral(tokens));
  } else {
    tokens.Fail(store.place, fmt::format("unknown store '{}'", store.text),
                "Kf, Kw, Kv, Kx or LCW");
  }
  tokens.Expect(")");
  return change;
}

// Adds the changes that come next. Returns whether they end in a comma that no change follows.
bool AddChanges(PksTokens& tokens, std::vector<Change>& changes) {
  do {
    if (!changes.empty() && !BeginsChange(tokens)) return true;
    changes.push_back(ReadChange(tokens));
  } while (tokens.TakeIf(","));
  return false;
}

// Adds an effect, and those that follow it after commas.
void AddEffects(PksTokens& tokens, std::vector<Effect>& effects) {
  bool ends_in_comma = false;
  do {
    Effect effect;
    effect.place = tokens.Peek().place;
    if (tokens.TakeWordIf("forall")) effect.variables = tokens.Variables();
    if (!BeginsChange(tokens)) {
      effect.condition = ReadQuery(tokens);
      tokens.Expect("=>");
    }
    ends_in_comma = AddChanges(tokens, effect.changes);
    effects.push_back(std::move(effect));
  } while (!tokens.Peek().Is(";") && !tokens.BeginsSection() && ends_in_comma);
}

}  // namespace

std::vector<Effect> ReadEffects(PksTokens& tokens) {
  std::vector<Effect> effects;
  do {
    AddEffects(tokens, effects);
  } while (tokens.TakeIf(";"));
  return effects;
}

std::vector<Change> ReadChanges(PksTokens& tokens) {
  std::vector<Change> changes;
  AddChanges(tokens, changes);
  return changes;
}

}  // namespace assay::contingent
