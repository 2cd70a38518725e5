#!/bin/sh
# shell_files.sh PROGRAM SHARE PREFIX: asks the program for what shells complete and for its help, and
# writes completions and man pages into the folder SHARE of an installation in PREFIX.
set -eu
program=$1
share=$2
prefix=$3
version=$("$program" --version)

# Turns a help text into a man page. An option or a word with its meaning, which begins in column 31,
# becomes a paragraph with a tag. Examples and tables stay as they are.
man_page() {
  awk -v name="$1" -v version="$version" '
    function plain(text) {
      gsub(/\\/, "\\e", text)
      gsub(/-/, "\\-", text)
      if (text ~ /^[.\x27]/) text = "\\&" text
      return text
    }
    function fill(on) {
      if (on == filled) return
      print on ? ".fi" : ".nf"
      filled = on
    }
    # Prints a line of options, which was held back until the next was seen: a tag that is too long
    # for its column has its meaning there.
    function release(is_tag_alone) {
      if (held == "") return
      print ".TP"
      print ".B " plain(substr(held, 3, is_tag_alone ? length(held) : 27))
      if (!is_tag_alone) print plain(substr(held, 31))
      held = ""
    }
    BEGIN { filled = 1 }
    NR == 1 {
      printf ".TH \"%s\" 1 \"\" \"%s\" \"User Commands\"\n", toupper(name), version
      printf ".SH NAME\n%s \\- %s\n", plain(name), plain($0)
      next
    }
    /^Usage: / { printf ".SH SYNOPSIS\n%s\n", plain(substr($0, 8)); next }
    /^[A-Z][A-Za-z ]*:$/ {
      release(0)
      fill(1)
      title = toupper(substr($0, 1, length($0) - 1))
      print ".SH " title
      tagged = title != "EXAMPLE" && title != "EXIT CODES"
      fill(tagged)
      next
    }
    /^ *$/ { release(0); next }
    /^[^ ]/ { release(0); fill(1); print ".PP"; print plain($0); next }
    !tagged { print plain($0); next }
    /^  [^ ]/ { release(0); held = $0; next }
    { release(1); sub(/^ +/, ""); print plain($0) }
    END { release(0) }'
}

write_man_page() {
  man_page "$1" | gzip -9n >"$share/man/man1/$1.1.gz"
}

write_completion() {
  mkdir -p "$(dirname "$share/$2")"
  "$program" completion "$1" >"$share/$2"
}

mkdir -p "$share/man/man1"
"$program" --help | write_man_page assay
for verb in $("$program" --help | awk '/^Verbs:$/ { on = 1; next } /^ *$/ { on = 0 } on { print $1 }'); do
  "$program" "$verb" --help | write_man_page "assay-$verb"
done

write_completion bash bash-completion/completions/assay
write_completion fish fish/vendor_completions.d/assay.fish
# Debian's zsh looks for what packages bring in a folder of its own.
if [ "$prefix" = /usr ]; then zsh=vendor-completions; else zsh=site-functions; fi
write_completion zsh "zsh/$zsh/_assay"
