# Completion of the uvol tools in bash: options, their words, and the fields of the file that is named. It
# knows what -h all says and what the head of a file says, so that it follows both.

# Lines "-name placeholder" of a tool's options.
_uvol_options()
{
  "$1" -h all 2>/dev/null | sed -En 's/^  (-[a-z0-9-]+)( ([^ ]+))?.*/\1 \3/p'
}

# Names of fields in the head of a file, however long the file is; uvol_info beside the tool knows other formats, and
# has two seconds for them.
# usage: _uvol_fields TOOL FILE
_uvol_fields()
{
  local info=${1%uvol_*}uvol_info file=$2
  case $file in
    *.csv | *.txt | *.xyz | *.dat | *.tsv) head -n 1 -- "$file" | tr -d '#"\r' | tr ',;\t ' '\n' ;;
    *.pcd) head -c 4096 -- "$file" | tr -d '\0' | sed -n 's/^FIELDS //p' | tr ' ' '\n' ;;
    *.ply) head -c 16384 -- "$file" | tr -d '\0' |
      awk '/^element/ { vertex = $2 == "vertex" } /^property/ && vertex { print $NF } /^end_header/ { exit }' ;;
    *.vtp | *.vtu | *.vts) head -c 8388608 -- "$file" | tr -d '\0' |
      grep -aoE '<DataArray[^>]*' | sed -En 's/.* Name="([^"]*)".*/\1/p' | sort -u ;;
    *) timeout 2 "$info" "$file" | sed -n 's/^fields: //p' | sed 's/ ([^)]*)//g; s/ and [0-9]* more$//; s/, /\n/g' ;;
  esac 2>/dev/null
}

_uvol()
{
  local tool=${COMP_WORDS[0]} first=1 word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} file words
  if [ "${tool##*/}" = uvol ]; then
    if [ "$COMP_CWORD" -eq 1 ]; then
      words=$(compgen -c uvol_ | sed 's/^uvol_//' | sort -u)
      mapfile -t COMPREPLY < <(compgen -W "$words --list-formats --version help" -- "$word")
      return
    fi
    tool=uvol_${COMP_WORDS[1]} first=2
  fi
  # The first word that is a file is the input.
  for file in "${COMP_WORDS[@]:first}" ""; do
    [ -f "${file/#\~/$HOME}" ] && file=${file/#\~/$HOME} && break
  done
  local dash=
  [[ $word == --* ]] && dash=-
  case ${before#-} in
    -*) before=${before#-} ;;
  esac
  case $before in
    -h | -help) # all, and headings of one word
      words=$("$tool" -h all 2>/dev/null | sed -En 's/^([A-Z][a-z]*):$/\L\1/p')
      mapfile -t COMPREPLY < <(compgen -W "all $words" -- "$word")
      return
      ;;
    -field | -color | -attributes | -label | -where | -validate-by)
      words=$([ -n "$file" ] && _uvol_fields "$tool" "$file")
      mapfile -t COMPREPLY < <(IFS=$'\n' compgen -W "$words" -- "${word##*,}")
      [[ $word == *,* ]] && COMPREPLY=("${COMPREPLY[@]/#/${word%,*},}")
      return
      ;;
    -*)
      words=$(_uvol_options "$tool" | sed -n "s/^$before \(.*|.*\)/\1/p" | tr '|' ' ')
      if [ -n "$words" ]; then
        mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
        return
      fi
      ;;
  esac
  if [[ $word == -* ]]; then
    words=$(_uvol_options "$tool" | sed -E "s/^(-[^ ]*).*/$dash\1/")
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  fi # else files, by the default of complete below
}

# shellcheck disable=SC2046
complete -o default -F _uvol uvol $(compgen -c uvol_ | sort -u)
