# Cans of unknown weight are lifted, weighed, and put on a second table; those that can spill are held
# upright on the way. senseWeight, transferUpright and the goal are those of the paper's table I, the
# other actions are derived. A can that is known to be empty or closed needs no sensing: !isSpillable
# of it in the problem's init (which `assay run` holds against the simulator, like all knowledge).
domain force-sensing

types: object
predicates: isGrasped(object), isRemoved(object), isSpillable(object), handEmpty

action grasp(?o: object)
  preconds: K(!isGrasped(?o)) & K(!isRemoved(?o)) & K(handEmpty)
  effects: add(Kf, isGrasped(?o)), add(Kf, !handEmpty)

action senseWeight(?o: object)
  preconds: !Kw(isSpillable(?o)) & K(isGrasped(?o))
  effects: add(Kw, isSpillable(?o))

action transferUpright(?o: object)
  preconds: K(isSpillable(?o)) & K(isGrasped(?o)) & K(!isRemoved(?o))
  effects: add(Kf, isRemoved(?o))

action transfer(?o: object)
  preconds: K(!isSpillable(?o)) & K(isGrasped(?o)) & K(!isRemoved(?o))
  effects: add(Kf, isRemoved(?o))

action ungrasp(?o: object)
  preconds: K(isGrasped(?o))
  effects: add(Kf, !isGrasped(?o)), add(Kf, handEmpty)
