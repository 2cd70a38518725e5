problem four-packages
domain bomb-in-the-toilet

objects: p1, p2, p3, p4: package
init: add(Kf, !clogged), add(Kx, armed(p1) | armed(p2) | armed(p3) | armed(p4))
goal: forallK(?p: package) K(!armed(?p))
