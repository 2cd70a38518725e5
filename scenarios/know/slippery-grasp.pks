# A grasp may slip; whether it held is sensed, and it is tried again until it does.
domain slippery-grasp

types: object
predicates: holding(object)

action tryToGrasp(?o: object)
  preconds: K(!holding(?o))
  effects: del(Kf, holding(?o)), add(Kw, holding(?o))
