# The goal as the paper's table III prints it. A bottle in the dishwasher is right whether it is empty
# or not, so that the shortest plan moves it there without looking: four actions and no branch. With
# the reading of one-bottle.pks the paper's plan comes out, five actions and a branch.
problem one-bottle-as-printed
domain visual-sensing

objects: left, right: robot, bottle: object, tableLeft, shared, tableRight: location
externs: isReachable(tableLeft, left), isReachable(shared, left), isReachable(shared, right),
         isReachable(tableRight, right), isReachable(dishwasher, right)
init: add(Kf, handEmpty(left)), add(Kf, handEmpty(right)), add(LCW, isOccupied(?l)),
      add(Kf, getObjectLocation(bottle) = tableLeft), add(Kf, isOccupied(tableLeft))
goal: forallK(?o: object) (K(getObjectLocation(?o) = dishwasher) | K(!isEmptyBottle(?o)))
