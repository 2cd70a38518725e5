# A file is in one of the directories of a tree, and has to be moved to the root. Listing a directory
# tells of every file whether it is there.
domain unix

types: file, directory
predicates: subdirectory(directory, directory), inDirectory(file, directory)
functions: working: directory

action cdDown(?from: directory, ?to: directory)
  preconds: K(subdirectory(?from, ?to)) & K(working = ?from)
  effects: add(Kf, working = ?to)

action cdUp(?from: directory, ?to: directory)
  preconds: K(subdirectory(?to, ?from)) & K(working = ?from)
  effects: add(Kf, working = ?to)

action ls(?d: directory)
  preconds: K(working = ?d)
  effects: add(LCW, inDirectory(?f, ?d))

action mv(?f: file, ?from: directory, ?to: directory)
  preconds: K(working = ?from) & K(inDirectory(?f, ?from))
  effects: add(Kf, !inDirectory(?f, ?from)), add(Kf, inDirectory(?f, ?to))
