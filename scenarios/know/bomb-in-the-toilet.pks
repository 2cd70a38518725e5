# One of the packages holds a bomb; dunking it makes it harmless (McDermott 1987).
domain bomb-in-the-toilet

types: package
predicates: armed(package), clogged

action dunk(?p: package)
  preconds: K(!clogged)
  effects: add(Kf, !armed(?p)), add(Kf, clogged)

action flush
  effects: add(Kf, !clogged)

action inspect(?p: package)
  preconds: !Kw(armed(?p))
  effects: add(Kw, armed(?p))
