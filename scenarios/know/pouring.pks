# Interval-valued knowledge: how much is in a jug is known within bounds, pouring adds a dose that is
# known within bounds, and a float tells whether it is full.
domain pouring

predicates: served
functions: level: number

action pour
  preconds: K(level < 8)
  effects: add(Kf, level = level + [1, 2])

action lookAtFloat
  preconds: !Kw(level >= 4)
  effects: add(Kw, level >= 4)

action serve
  preconds: K(level >= 4)
  effects: add(Kf, served)
