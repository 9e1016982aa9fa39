# bash completion of stampede: source this file
_stampede() {
  local word="${COMP_WORDS[COMP_CWORD]}" words="list check run evaluate show plan validate query index merge lock make verify cluster export import paraphrase questions dataset baseline score replay render new doc --help --version"
  [ "$COMP_CWORD" -gt 1 ] && case "${COMP_WORDS[1]}" in
    list) words="--sheet --hash --force --root --path --json --help" ;;
    check) words="--physics --why --pictures --episodes --seed --randomise --workers --force --root --path --json --help" ;;
    run) words="--episodes --variation --seed --split --on-failure --controller --motion-planner --randomise --where --goal --behaviour --skills --set --images --camera --size --kinds --noise --shadows --renderer --camera-file --add-camera --channels --workers --out --shard --plan --sentences --planner --policy --policy-timeout --observe --reward --root --path --json --help" ;;
    evaluate) words="--perturb --episodes --variation --seed --split --workers --out --shard --policy --policy-timeout --observe --reward --images --camera --size --kinds --noise --shadows --renderer --camera-file --add-camera --channels --root --path --json --help" ;;
    show) words="--all --frame --as --leave-out --root --path --json --help" ;;
    plan) words="--variation --seed --pddl --task-sized --bddl --leave-out --where --goal --k --expansions --planner --root --path --json --help" ;;
    validate) words="--root --path --json --help" ;;
    query) words="--format --list --views --datasette --hash --root --path --json --help" ;;
    index) words="--root --path --json --help" ;;
    merge) words="--mixed --root --path --json --help" ;;
    lock) words="--root --path --json --help" ;;
    make) words="--out --workers --shard --anyway --root --path --json --help" ;;
    verify) words="--root --path --json --help" ;;
    cluster) words="--shards --out --sbatch --image --claim --workers --episodes --variation --seed --split --on-failure --controller --motion-planner --randomise --where --goal --behaviour --skills --set --images --camera --size --kinds --noise --shadows --renderer --camera-file --add-camera --channels --root --path --json --help" ;;
    export) words="--out --episode --known --dialect --mapping --frame --leave-out --force --root --path --json --help" ;;
    import) words="--task --world --mapping --episodes --seed --out --frame-hz --workers --episode --root --path --json --help" ;;
    paraphrase) words="--variation --seed --count --each --grain --level --dry-run --show-refused --out --url --model --timeout --retries --rate --price-in --price-out --root --path --json --help" ;;
    questions) words="--out --per-frame --frames --rephrase --url --model --timeout --retries --rate --price-in --price-out --force --root --path --json --help" ;;
    dataset) words="--list --out --hidden --split --where --root --path --json --help" ;;
    baseline) words="--list --out --force --root --path --json --help" ;;
    score) words="--hidden --out --figure --episode --physics --workers --force --root --path --json --help" ;;
    replay) words="--root --path --json --help" ;;
    render) words="--out --into --video --sheet --overlay --frames --camera --size --kinds --noise --shadows --renderer --camera-file --add-camera --workers --force --root --path --json --help" ;;
    new) words="--root --path --json --help" ;;
    doc) words="--check --root --path --json --help" ;;
  esac
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o default -F _stampede stampede
