#include "planner/contingent/grounding/grounding.h"

#include "planner/contingent/grounding/action_grounding.h"
#include "planner/contingent/grounding/atom_table.h"
#include "planner/contingent/grounding/initial_grounding.h"
#include "planner/contingent/language/type_check.h"

namespace assay::contingent {

GroundTask Ground(Domain domain, Problem problem, Externs& externs, KnownFacts facts) {
  const SymbolTable symbols(domain, problem);
  CheckTypes(domain, problem, symbols);
  externs.AddFacts(problem);
  GroundTask task;
  task.domain_file = domain.file;
  AtomTable table(domain, problem, symbols, task);
  TermGrounding terms(symbols, table, task);
  QueryGrounding queries(terms, externs);
  EffectGrounding effects(terms, queries);
  InitialGrounding initial(problem, terms, effects);
  ActionGrounding actions(terms, queries, effects);

  initial.Tell();
  terms.Enter(domain.file);
  for (const Action& action : domain.actions) actions.AddInstances(action);
  for (const Effect& update : domain.updates) effects.AddEffects(update, {}, task.updates);
  terms.Enter(problem.file);
  task.goal = queries.QueryOf(problem.goal, {});
  task.goal_place = terms.PlaceOf(problem.goal.place);
  if (facts == KnownFacts::kAll) table.AddKnown();
  initial.Ground();
  return task;
}

}  // namespace assay::contingent
