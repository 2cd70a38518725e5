# Of each bottle it must come to be known whether it is empty; those that are must be in the
# dishwasher. The goal as printed, which does not ask the former: one-bottle-as-printed.pks.
problem one-bottle
domain visual-sensing

objects: left, right: robot, bottle: object, tableLeft, shared, tableRight: location
externs: isReachable(tableLeft, left), isReachable(shared, left), isReachable(shared, right),
         isReachable(tableRight, right), isReachable(dishwasher, right)
init: add(Kf, handEmpty(left)), add(Kf, handEmpty(right)), add(LCW, isOccupied(?l)),
      add(Kf, getObjectLocation(bottle) = tableLeft), add(Kf, isOccupied(tableLeft))
goal: forallK(?o: object) (K(!isEmptyBottle(?o)) |
                           K(isEmptyBottle(?o)) & K(getObjectLocation(?o) = dishwasher))
