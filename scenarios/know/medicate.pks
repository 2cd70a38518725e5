# A patient has one of some illnesses. The right drug cures, a wrong one kills. A stain makes each
# illness show its own colour in the blood, so that looking at a colour tells about the illness.
domain medicate

types: illness
predicates: ill(illness), stained(illness), cured, dead

action stain
  effects: forall (?i: illness) K(ill(?i)) => add(Kf, stained(?i))

action inspect(?i: illness)
  preconds: !Kw(stained(?i))
  effects: add(Kw, stained(?i))

action medicate(?i: illness)
  effects: K(ill(?i)) => add(Kf, cured), add(Kf, !ill(?i));
           K(!ill(?i)) => add(Kf, dead)
