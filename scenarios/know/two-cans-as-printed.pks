# The goal as the paper's table I prints it, with "or": nothing is grasped, so that it holds at once and
# the plan is empty. The plan of its table II is that of the goal with "and", two-cans.pks.
problem two-cans-as-printed
domain force-sensing

objects: can1, can2: object
init: add(Kf, handEmpty), add(LCW, isGrasped(?o)), add(LCW, isRemoved(?o))
goal: forallK(?o: object) (K(isRemoved(?o)) | K(!isGrasped(?o)))
