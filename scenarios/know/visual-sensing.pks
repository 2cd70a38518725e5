# Bottles on a table; a camera tells which of them are empty; two arms, each of which reaches a part
# of the table, clear the empty ones away. senseIfEmpty, pickUp and the goal are those of the paper's
# table III; putDown is derived: a location takes one bottle, the dishwasher any number.
domain visual-sensing

types: robot, object, location
predicates: handEmpty(robot), inHand(object, robot), isEmptyBottle(object), isOccupied(location)
functions: getObjectLocation(object): location
externs: isReachable(location, robot)
constants: dishwasher: location

action senseIfEmpty(?o: object)
  preconds: !Kw(isEmptyBottle(?o))
  effects: add(Kw, isEmptyBottle(?o))

action pickUp(?r: robot, ?o: object, ?l: location)
  preconds: K(?l = getObjectLocation(?o)) & K(handEmpty(?r)) & K(extern(isReachable(?l, ?r)))
  effects: del(Kf, ?l = getObjectLocation(?o)), del(Kf, handEmpty(?r)), add(Kf, inHand(?o, ?r)),
           add(Kf, !isOccupied(?l))

action putDown(?r: robot, ?o: object, ?l: location)
  preconds: K(inHand(?o, ?r)) & K(extern(isReachable(?l, ?r))) & K(!isOccupied(?l))
  effects: add(Kf, getObjectLocation(?o) = ?l), add(Kf, handEmpty(?r)), del(Kf, inHand(?o, ?r));
           K(?l != dishwasher) => add(Kf, isOccupied(?l))
