# Of each bottle it must come to be known whether it is empty; those that are must be in the
# dishwasher. The goal as printed, which does not ask the former: one-bottle-as-printed.pks.
problem three-bottles
domain visual-sensing

objects: left, right: robot, bottle1, bottle2, bottle3: object,
         tableLeft, tableBack, shared, tableRight: location
externs: isReachable(tableLeft, left), isReachable(tableBack, left), isReachable(shared, left),
         isReachable(shared, right), isReachable(tableRight, right), isReachable(dishwasher, right)
init: add(Kf, handEmpty(left)), add(Kf, handEmpty(right)), add(LCW, isOccupied(?l)),
      add(Kf, getObjectLocation(bottle1) = tableLeft), add(Kf, isOccupied(tableLeft)),
      add(Kf, getObjectLocation(bottle2) = tableBack), add(Kf, isOccupied(tableBack)),
      add(Kf, getObjectLocation(bottle3) = tableRight), add(Kf, isOccupied(tableRight))
goal: forallK(?o: object) (K(!isEmptyBottle(?o)) |
                           K(isEmptyBottle(?o)) & K(getObjectLocation(?o) = dishwasher))
