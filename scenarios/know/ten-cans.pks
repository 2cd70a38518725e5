problem ten-cans
domain force-sensing

objects: can1, can2, can3, can4, can5, can6, can7, can8, can9, can10: object
init: add(Kf, handEmpty), add(LCW, isGrasped(?o)), add(LCW, isRemoved(?o))
goal: forallK(?o: object) (K(isRemoved(?o)) & K(!isGrasped(?o)))
