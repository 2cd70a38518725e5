problem hold-the-cup
domain slippery-grasp

objects: cup: object
init: add(Kf, !holding(cup))
goal: K(holding(cup))
