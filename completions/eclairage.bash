# Completion of eclairage for bash. Made by: eclairage --print-bash-completion

_eclairage()
{
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
  local command='' i
  COMPREPLY=()

  # Bash makes three words of --color=auto; the option is the first of them.
  if [[ $word == = ]]; then
    word=''
  elif [[ $before == = ]]; then
    before=${COMP_WORDS[COMP_CWORD-2]}
  fi

  # The value of an option.
  case $before in
    -o|--output)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -f -- "$word")
      return
      ;;
    --out)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "$word")
      return
      ;;
    --aov)
      local given=''
      [[ $word != *,* ]] || given=${word%,*},
      compopt -o nospace 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -P "$given" -W 'normal depth id albedo ambient emission diffuse specular background reflection transmission shadow all' -- "${word##*,}")
      return
      ;;
    --svg)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -f -- "$word")
      return
      ;;
    --width)
      return
      ;;
    --height)
      return
      ;;
    --model)
      mapfile -t COMPREPLY < <(compgen -W 'simple lambert phong blinn_phong' -- "$word")
      return
      ;;
    --samples)
      return
      ;;
    --threads)
      return
      ;;
    --engine)
      mapfile -t COMPREPLY < <(compgen -W 'fast reference' -- "$word")
      return
      ;;
    --encoding)
      mapfile -t COMPREPLY < <(compgen -W 'srgb linear' -- "$word")
      return
      ;;
    --bit-depth)
      mapfile -t COMPREPLY < <(compgen -W '8 16' -- "$word")
      return
      ;;
    --fail)
      return
      ;;
    --fail-percent)
      return
      ;;
    --hard-fail)
      return
      ;;
    --rmse)
      return
      ;;
    --ssim)
      return
      ;;
    --flip)
      return
      ;;
    --color)
      mapfile -t COMPREPLY < <(compgen -W 'auto always never' -- "$word")
      return
      ;;
  esac

  # Options and operands, by the command.
  for ((i = 1; i < COMP_CWORD; i++)); do
    case ${COMP_WORDS[i]} in
    render|pov|compare|diff|explain|why|check|schema)
      command=${COMP_WORDS[i]}
      break
      ;;
    esac
  done
  local options operands=
  case $command in
  render)
    options='-o --output --aov --width --height --model --samples --threads --engine --encoding --bit-depth --json -q --quiet --color -h --help --version'
    operands='@(*.yaml|*.yml)'
    ;;
  pov)
    options='-o --output --width --height --model --samples --encoding --bit-depth -q --quiet --color -h --help --version'
    operands='@(*.yaml|*.yml)'
    ;;
  compare)
    options='--out --per-term --width --height --model --samples --threads --engine --encoding --bit-depth --fail --fail-percent --hard-fail --rmse --ssim --flip --json -q --quiet --color -h --help --version'
    operands='@(*.yaml|*.yml)'
    ;;
  diff)
    options='-o --output --fail --fail-percent --hard-fail --rmse --ssim --flip --json -q --quiet --color -h --help --version'
    operands='*.png'
    ;;
  explain)
    options='--out --width --height --model --samples --threads --engine --json -q --quiet --color -h --help --version'
    operands='@(*.yaml|*.yml|*.png)'
    ;;
  why)
    options='--svg --width --height --model --samples --encoding --bit-depth --json -q --quiet --color -h --help --version'
    operands='@(*.yaml|*.yml)'
    ;;
  check)
    options='--json -q --quiet --color -h --help --version'
    operands='@(*.yaml|*.yml)'
    ;;
  schema)
    options='-q --quiet --color -h --help --version'
    ;;
  *)
    options='render pov compare diff explain why check schema --help --version'
    ;;
  esac

  if [[ $word == -* || -z $command ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  elif [[ -n $operands ]]; then
    # Files of the kind that is wanted, and folders on the way to them.
    compopt -o filenames 2>/dev/null
    local extended
    extended=$(shopt -p extglob)
    shopt -s extglob
    mapfile -t COMPREPLY < <(
      compgen -f -X "!$operands" -- "$word"
      compgen -d -- "$word"
    )
    $extended
  fi
}

complete -F _eclairage eclairage
