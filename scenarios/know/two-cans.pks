problem two-cans
domain force-sensing

objects: can1, can2: object
init: add(Kf, handEmpty), add(LCW, isGrasped(?o)), add(LCW, isRemoved(?o))
goal: forallK(?o: object) (K(isRemoved(?o)) & K(!isGrasped(?o)))
