// A group's way from the sketch by steps of its own, and its pins at any place between; the rules are those of Python's `rules`.
const correct=(f,u,size)=>{
  let last=1/0;
  for(let k=0;;k++){
    const [step,,raw]=f,n=u.length,r=step(u);
    let v=r.slice(0,n),change=r[n];
    if(!(r[n+1]>0)&&u.every(Number.isFinite)){
      const e=raw(u),x=J([...e.slice(n),...e.slice(0,n)]);
      v=u.map((a,j)=>a-x[j]);
      change=x.reduce((a,b)=>M(a,A(b)),0);
    }
    const [end,near]=ended(change,last,size);
    u=v;
    if(end>0||k==ITERATIONS-1)return [u,near>0?1:0];
    last=change;
  }
};
// The clearance by a Jacobian with pivots of its own: 2 over its condition, with the sign of its determinant.
const clearance=(e,n)=>{
  const a=[];
  for(let k=0;k<n;k++){
    const r=e.slice(n+k*n,2*n+k*n),l=Q(r.reduce((s,b)=>s+b*b,0));
    a.push([...r.map(b=>b/l),...r.map((b,j)=>+(j==k))]);
  }
  if(!a.every(r=>r.every(Number.isFinite)))return NaN;
  let sign=1,size=0;
  for(let k=0;k<n;k++){
    let b=k;
    for(let i=k+1;i<n;i++)if(A(a[i][k])>A(a[b][k]))b=i;
    const t=a[b],q=t[k];
    if(b>k){a[b]=a[k];a[k]=t;sign=-sign;}
    if(!q)return 0;
    if(q<0)sign=-sign;
    for(let j=0;j<2*n;j++)t[j]/=q;
    for(let i=0;i<n;i++)if(i!=k){
      const f=a[i][k];
      for(let j=0;j<2*n;j++)a[i][j]-=f*t[j];
    }
  }
  for(const r of a)for(const b of r.slice(n))size+=b*b;
  return sign*I(1,2*Q(n)/Q(size));
};
const sense=(f,u)=>{
  const [clear,size,pivot]=f[1](u);
  return [pivot>0?clear:clearance(f[2](u),u.length),size];
};
// at(t): what is known of the group at a place; `exact`: the way ends at its goal, else at the first of its own steps behind it.
const way=(at,t,u,largest,exact)=>{
  let [s,size]=sense(at(t),u),before=t,earlier=t,w=u,x=u,step=FIRST*largest,going=A(s)>=TOUCH?1:0;
  const kept=[[t,s,size,u]],self={kept,end:s-s===0?1/0:-1};
  self.follow=goal=>{
    const limit=exact?goal:1/0;
    while(going&&t<goal){
      let ahead,line=[],start=[];
      for(let j=0;j<u.length;j++)[ahead,line[j],start[j]]=predicted(step,limit,t,before,earlier,u[j],w[j],x[j]);
      const f=at(ahead),[v,near]=correct(f,start,size),[now,extent]=sense(f,v);
      const [good,next]=judged(ahead-t,s,largest,near,v.reduce((a,b,j)=>M(a,A(b-line[j])),0),now,extent);
      if(good>0){
        earlier=before;before=t;t=ahead;x=w;w=u;u=v;s=now;size=extent;
        kept.push([t,s,size,u]);
      }
      step=next;
      [going]=goes(t,s,step,largest);
    }
    if(self.end>=0)self.end=t>=goal?1/0:t;
    self.last=u;
    return self;
  };
  self.at=place=>{
    let low=0,high=kept.length;
    while(high-low>1){const k=low+high>>1;if(kept[k][0]<=place)low=k;else high=k;}
    const end=kept.length-1,l=kept[low=M(0,I(low,end-1))],r=kept[I(low+1,end)],b=kept[M(low-1,0)];
    if(!(place<=self.end))return u.map(()=>NaN);
    let bound,guess=[];
    for(let j=0;j<u.length;j++)[guess[j],bound]=between(place,b[0],l[0],r[0],b[3][j],l[3][j],r[3][j],A(l[1]),A(r[1]),l[2],r[2]);
    const [v,near]=correct(at(place),guess,l[2]);
    if(near&&v.reduce((a,c,j)=>M(a,A(c-guess[j])),0)<=bound)return v;
    if(!(r[0]>l[0]))return u.map(()=>NaN);
    const again=way(at,l[0],l[3],.25*(r[0]-l[0]),1).follow(place);
    return again.end<1/0?u.map(()=>NaN):again.last;
  };
  return self;
};
// The ways of all groups, each followed with those before it known; inputs(t) gives dimensions and strokes at a place.
const route=(inputs,start,goal,largest,exact)=>{
  const found=[];
  groups.forEach(([first,equations],k)=>{
    const at=t=>{
      const [d,p]=inputs(t);
      for(let j=0;j<k;j++)found[j].at(t).forEach((v,c)=>p[groups[j][0]+c]=v);
      return equations(d,p);
    };
    found.push(way(at,0,start[k],largest,exact).follow(exact?goal:goal+(groups.length-1-k)*largest));
  });
  return found;
};
const arrived=ways=>ways.map(w=>w.end<1/0?w.last.map(()=>NaN):w.last);
const groupsOf=d=>{
  const changed=d.some((v,k)=>v!==d0[k]),up=[];
  const start=changed?arrived(route(t=>[d.map((v,k)=>v===d0[k]?v:d0[k]+t*(v-d0[k])),[...sketch]],seeds,1,LINE,1)):seeds;
  let goals=[];
  return p=>{
    const q=p.slice(0,sketch.length);
    let found;
    if(q.length==1){
      const sign=q[0]>=sketch[0]?1:-1,place=A(q[0]-sketch[0]),k=sign>0?0:1;
      if(!(goals[k]>=place)){
        goals[k]=M(place,reach[k]);
        up[k]=route(t=>[d,[sketch[0]+t*sign]],start,goals[k],LARGEST,0);
      }
      found=up[k].map(w=>w.at(place));
    }else found=arrived(route(t=>[d,sketch.map((s,k)=>s+t*(q[k]-s))],start,1,LINE,1));
    found.forEach((u,k)=>{
      const [first,equations]=groups[k];
      const s=sense(equations(d,p),u)[0];
      u.forEach((v,c)=>p[first+c]=v);
      p[first+u.length]=u.every(Number.isFinite)?s-s===0?A(s):0:NaN;
    });
  };
};
